//! The constants that stand in the files of Beckmann's formulas: what they are promised to keep over
//! the default domain, on a grid of it with its edges.

use lobefit::effects::reflection::BECKMANN;
use lobefit_promises::{Fitted, Range, broken};
use lobefit_shade::Hypothesis;
use lobefit_truth::optics::Smith;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::BECKMANN_REFLECTION;

/// Places along an axis.
const N: usize = 160;

#[test]
fn the_constants_in_the_files_keep_what_is_promised() {
    let at = |i: usize, low: f64| low + (1.0 - low) * i as f64 / (N - 1) as f64;
    let roughness: Vec<f64> = (0..N * N).map(|i| at(i / N, 0.02)).collect();
    // Closer together at grazing views.
    let mu: Vec<f64> = (0..N * N).map(|i| at(i % N, 0.1) * at(i % N, 0.1)).collect();
    let alpha: Vec<f64> = roughness.iter().map(|r| r * r).collect();
    let points = Points::new([("alpha", alpha.clone()), ("mu", mu.clone())]);
    let truth =
        BECKMANN_REFLECTION.truth(&Smith::Correlated.into(), &points, &["E", "B"], 1e-7).expect("values");
    let [e, b] = truth.arrays();
    let error = |formula: &Hypothesis, f0: f64, wanted: &dyn Fn(usize, f64) -> f64| {
        let column = |name: &String| match name.as_str() {
            "roughness" => roughness.clone(),
            "alpha" => alpha.clone(),
            "mu" => mu.clone(),
            _ => vec![f0; N * N],
        };
        let inputs: Vec<Vec<f64>> = formula.inputs().iter().map(column).collect();
        let values = formula.tape().evaluate(&inputs, &formula.starts()).expect("values");
        values.iter().enumerate().map(|(i, value)| wanted(i, *value).abs()).fold(0.0, f64::max)
    };
    let parsed: Vec<Hypothesis> = BECKMANN
        .entries()
        .map(|entry| Hypothesis::parse(entry.file, entry.source).expect("a formula"))
        .collect();
    let found = parsed.iter().map(|formula| {
        let at_ends = |of: &dyn Fn(f64, f64) -> f64| {
            let of_b = error(formula, 0.0, &|i, value| of(value, b[i]));
            error(formula, 1.0, &|i, value| of(value, e[i])).max(of_b)
        };
        let is_norm = formula.name().starts_with("beckmann_norm_");
        let of_norm = || error(formula, 1.0, &|i, n| n * e[i] - 1.0);
        let [error, relative] = match is_norm {
            true => [of_norm(); 2],
            false => [at_ends(&|value, truth| value - truth), at_ends(&|value, truth| value / truth - 1.0)],
        };
        let f0 = (!is_norm).then(|| Range("f0".into(), 0.0, 1.0));
        let others = [Range("mu".into(), 0.01, 1.0), Range("roughness".into(), 0.02, 1.0)];
        let domain = f0.into_iter().chain(others).collect();
        Fitted { name: formula.name(), ops: formula.tape().cost_ops(), error, relative, domain }
    });
    let found: Vec<Fitted> = found.collect();
    // The rows of the page are those of a bake, which searches the largest errors.
    let page = include_str!("../../docs/scene.md");
    let row = |name: &str| page.lines().find_map(|line| line.strip_prefix(&format!("| `{name}` | ")));
    for fit in found.iter().filter(|fit| fit.name.starts_with("beckmann_norm_")) {
        let (ops, error) =
            row(fit.name).and_then(|row| row.split_once(" | ")).expect("a row of docs/scene.md");
        let error: f64 = error.trim_end_matches(" |").parse().expect("a number");
        assert!(
            ops == fit.ops.to_string() && (fit.error / error - 1.0).abs() < 0.03,
            "{} {}",
            fit.name,
            fit.error
        );
    }
    let broken = broken("tests/effects/beckmann_fits.rs", &found);
    assert!(broken.is_empty(), "docs/promises.json:\n{}", broken.join(",\n"));
}
