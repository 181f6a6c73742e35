//! What the tests of fits share: the hypotheses' files and a small quadrature of the GGX albedo.
#![allow(dead_code, clippy::disallowed_methods)]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock};

use lobefit_fit::Samples;
use lobefit_shade::Hypothesis;

/// The folder of hypotheses.
pub fn folder() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = package.ancestors().map(|at| at.join("fits/hypotheses")).find(|folder| folder.is_dir());
    folder.expect("the repository's hypotheses")
}

/// A hypothesis of the folder, by name.
pub fn hypothesis(name: &str) -> Hypothesis {
    let path = folder().join(format!("{name}.wgsl"));
    let source = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    Hypothesis::parse(&format!("{name}.wgsl"), &source).unwrap_or_else(|e| panic!("{e}"))
}

/// A hypothesis from text.
pub fn parse(source: &str) -> Hypothesis {
    Hypothesis::parse("test.wgsl", source).unwrap_or_else(|e| panic!("{e}"))
}

/// GGX reflection albedo, height-correlated Smith, F = 1: a one-dimensional integral over the
/// light's polar angle, the azimuth in closed form; m = tan((theta_l - theta) / 2) = alpha sinh(u),
/// panels of length 1 in u with 16 Gauss nodes, the last graded at the horizon. About 1e-9 for
/// alpha and mu above 1e-3.
pub fn albedo(alpha: f64, mu: f64) -> f64 {
    let theta = mu.acos();
    let a2 = alpha * alpha;
    let lambda_root = |x: f64| (x * x + a2 * (1.0 - x * x)).sqrt();
    let integrand = |u: f64| {
        let m = alpha * u.sinh();
        let light = theta + 2.0 * m.atan();
        let (half_d, half_s) = ((theta - light) / 2.0, (theta + light) / 2.0);
        let p = half_d.sin().powi(2) + a2 * half_d.cos().powi(2);
        let q = half_s.sin().powi(2) + a2 * half_s.cos().powi(2);
        let c = half_d.cos() * half_s.cos();
        let pq = p * q;
        let k = 2.0
            * a2
            * (1.0
                + 2.0 * (1.0 - a2) * c / pq.sqrt()
                + (1.0 - a2).powi(2) * c * (half_s.cos().powi(2) * p + half_d.cos().powi(2) * q)
                    / (2.0 * pq * pq.sqrt()));
        let mu_l = light.cos().max(0.0);
        let g = 2.0 * mu_l / (mu_l * lambda_root(mu) + mu * lambda_root(mu_l));
        g * k / 4.0 * light.sin() * 2.0 * alpha * u.cosh() / (1.0 + m * m)
    };
    let low = ((-theta / 2.0).tan() / alpha).asinh();
    let high = (((std::f64::consts::FRAC_PI_2 - theta) / 2.0).tan() / alpha).asinh();
    let panels = (high - low).ceil().max(1.0) as usize;
    let length = (high - low) / panels as f64;
    static NODES: OnceLock<Vec<(f64, f64)>> = OnceLock::new();
    let nodes = NODES.get_or_init(|| gauss(24));
    let mut sum = 0.0;
    for panel in 0..panels - 1 {
        let start = low + panel as f64 * length;
        sum += nodes.iter().map(|(x, w)| w * length * integrand(start + x * length)).sum::<f64>();
    }
    // u = high - length y^4
    sum += nodes
        .iter()
        .map(|(y, w)| w * 4.0 * y.powi(3) * length * integrand(high - length * y.powi(4)))
        .sum::<f64>();
    sum
}

/// Gauss-Legendre nodes and weights on [0, 1].
fn gauss(n: usize) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..20 {
            let (mut p0, mut p1) = (1.0, x);
            for k in 2..=n {
                (p0, p1) = (p1, ((2 * k - 1) as f64 * x * p1 - (k - 1) as f64 * p0) / k as f64);
            }
            slope = n as f64 * (x * p1 - p0) / (x * x - 1.0);
            x -= p1 / slope;
        }
        (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(node).collect()
}

/// Furnace samples of a hypothesis at the centres of `n` x `n` cells, and on the edges if wanted,
/// over roughness [0.02, 1] and mu [0.01, 1], alpha = roughness^2.
pub fn furnace(hypothesis: &Hypothesis, n: usize, edges: bool) -> Samples {
    let inner =
        |i: usize| (0.02 + 0.98 * (i as f64 + 0.5) / n as f64, 0.01 + 0.99 * (i as f64 + 0.5) / n as f64);
    let mut grid: Vec<(f64, f64)> = (0..n * n).map(|i| (inner(i / n).0, inner(i % n).1)).collect();
    if edges {
        let edge = |i: usize| [(inner(i).0, 0.01), (inner(i).0, 1.0), (0.02, inner(i).1), (1.0, inner(i).1)];
        grid.extend((0..n).flat_map(edge));
        grid.extend([(0.02, 0.01), (0.02, 1.0), (1.0, 0.01), (1.0, 1.0)]);
    }
    let column = |name: &String| {
        let value = |&(roughness, mu): &(f64, f64)| match name.as_str() {
            "roughness" => roughness,
            "alpha" => roughness * roughness,
            "mu" => mu,
            other => panic!("no input {other}"),
        };
        grid.iter().map(value).collect()
    };
    Samples {
        inputs: hypothesis.inputs().iter().map(column).collect(),
        scale: albedos((n, edges), &grid),
        target: vec![1.0; grid.len()],
    }
}

/// The albedo at the places of a furnace's grid, integrated once for every formula.
fn albedos(of: (usize, bool), grid: &[(f64, f64)]) -> Vec<f64> {
    static KNOWN: Mutex<BTreeMap<(usize, bool), Vec<f64>>> = Mutex::new(BTreeMap::new());
    let mut known = KNOWN.lock().expect("no integral fails");
    let integrated =
        || grid.iter().map(|&(roughness, mu)| albedo(roughness * roughness, mu)).collect::<Vec<f64>>();
    known.entry(of).or_insert_with(integrated).clone()
}
