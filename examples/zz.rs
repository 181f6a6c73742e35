use lobefit::data::Smith;
use lobefit::integrate::aniso::table::{self, Columns, Grid};
use std::time::Instant;
fn cpu() -> f64 { let s = std::fs::read_to_string("/proc/self/stat").unwrap(); let f: Vec<&str> = s.rsplit(") ").next().unwrap().split(' ').collect(); (f[11].parse::<f64>().unwrap() + f[12].parse::<f64>().unwrap()) / 100.0 }
fn main() {
    let which = std::env::args().nth(1).unwrap_or("s".into());
    let tols: Vec<f64> = std::env::args().skip(2).map(|x| x.parse().unwrap()).collect();
    let mus: Vec<f64> = (0..64).map(|x| (x as f64 / 64.0).clamp(1e-4, 0.9999)).collect();
    let alphas: Vec<f64> = (0..64).map(|x| (x as f64 / 64.0).clamp(1e-4, 1.0)).collect();
    let aspects: Vec<f64> = (0..32).map(|z| (1.0 - 0.9 * (z as f64 / 32.0).sqrt()).sqrt()).collect();
    let ours_a: Vec<f64> = (0..64).map(|x| { let r = 0.02 + 0.98 * x as f64 / 63.0; r * r }).collect();
    let ours_s: Vec<f64> = (0..32).map(|z| (1.0 - 0.9 * z as f64 / 31.0).sqrt()).collect();
    let warp = |c: usize, a: f64, _s: f64| { let u = c as f64 / 63.0; (a * u * u / ((1.0 - u * u) + a)).clamp(1e-3, 1.0) };
    for tol in tols {
        for smith in [Smith::Separable, Smith::Correlated] {
        let grid = if which == "s" { Grid { columns: Columns::Fixed(&mus), alphas: &alphas, aspects: &aspects, floor: 1e-4 } }
            else { Grid { columns: Columns::Varying { count: 64, mu: &warp }, alphas: &ours_a, aspects: &ours_s, floor: 0.0 } };
        let (t, c) = (Instant::now(), cpu());
        let r = table::tabulate(smith, &grid, tol);
        let (w, c) = (t.elapsed().as_secs_f64(), cpu() - c);
        match r { Ok(r) => println!("{tol:e} {smith:?} wall {w:.3} cpu {c:.2} evals {:.2e} checks {:.2e} n {} worst {:.1e} at {:?}", r.evaluations as f64, r.checked.evaluations as f64, r.checked.texels, r.checked.worst, r.checked.at), Err(e) => println!("{tol:e} {smith:?} wall {w:.3} cpu {c:.2} {e}") }
    }}
}
