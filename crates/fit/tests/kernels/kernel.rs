//! Hot kernels: what each returns is a sum of results. The counts of instructions (`tests/kernels`) and the
//! benches (`benches/kernels.rs`) run them.

use std::hint::black_box;

use lobefit_fit::texels::{self, Lattice, Wanted};
use lobefit_fit::{Goal, Options, Samples, optimise};
use lobefit_math::ops;
use lobefit_shade::{Hypothesis, Precision, measure_in};
use lobefit_truth::integrate::Path as Instructions;
use lobefit_truth::integrate::aniso::fast::{Place, many as aniso};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::optics::Smith;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{GGX_GLASS, GGX_REFLECTION, Quantity, Variant};

/// A kernel, the name of its function being that of its count; what it returns is a sum of results.
pub type Kernel = (&'static str, fn() -> f64);

/// All of them.
pub const KERNELS: [Kernel; 9] = [
    ("reflection_at_points", reflection_at_points),
    ("reflection_at_many", reflection_at_many),
    ("glass_at_many", glass_at_many),
    ("anisotropy_at_many", anisotropy_at_many),
    ("fit", fit),
    ("texel_optimiser", texel_optimiser),
    ("formula_in_f32", formula_in_f32),
    ("formula_in_f16", formula_in_f16),
    ("parse", parse),
];

/// `count` values from `low` to 1, their logarithms evenly spaced.
fn spaced(low: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| ops::pow(low, 1.0 - i as f64 / (count - 1) as f64)).collect()
}

#[inline(never)]
fn reflection_at_points() -> f64 {
    let variant = Variant::from(Smith::Correlated);
    let value = |alpha: &f64| {
        let mus = spaced(0.01, 6);
        let value = |mu: &f64| GGX_REFLECTION.at(&variant, &[*alpha, *mu], 1e-9).expect("a value")[0];
        mus.iter().map(value).sum::<f64>()
    };
    spaced(0.01, 6).iter().map(value).sum()
}

/// The first output, summed, at every combination of inputs.
fn many(quantity: &dyn Quantity, axes: &[(&str, &[f64])]) -> f64 {
    let mut variant = Variant::from(Smith::Correlated);
    variant.side = quantity.name().contains("glass").then_some(Side::Outside);
    let (tolerance, outputs) = (quantity.tolerance_of_many(&variant), &quantity.outputs()[..1]);
    let truth = quantity.truth(&variant, &Points::product(axes), outputs, tolerance).expect("values");
    truth.columns[0].iter().sum()
}

#[inline(never)]
fn reflection_at_many() -> f64 {
    many(GGX_REFLECTION, &[("alpha", &spaced(0.01, 16)), ("mu", &spaced(0.01, 16))])
}

#[inline(never)]
fn glass_at_many() -> f64 {
    many(GGX_GLASS, &[("alpha", &[0.1, 0.5]), ("mu", &[0.1, 0.6]), ("ior", &[1.3, 1.6])])
}

#[inline(never)]
fn anisotropy_at_many() -> f64 {
    // valgrind 3.19 does not know all that the best path has.
    let place = |i: usize| Place {
        alpha: [[0.1, 0.3, 0.9][i % 3], [0.2, 0.6][i / 3 % 2]],
        mu: [0.1, 0.6, 0.9][i / 6],
        phi: None,
    };
    let places: Vec<Place> = (0..18).map(place).collect();
    aniso(Instructions::Baseline, Smith::Correlated, &places, 1e-5).expect("values").e.iter().sum()
}

/// A formula of the product, as it stands in its file.
fn formula() -> Hypothesis {
    let text = include_str!("../../../../fits/hypotheses/ggx_norm_i14.wgsl");
    Hypothesis::parse("ggx_norm_i14.wgsl", text).expect("a formula")
}

/// `n` x `n` places of alpha and mu, in the order of a formula's inputs.
fn places(formula: &Hypothesis, n: usize) -> Vec<Vec<f64>> {
    let along = |i: usize| 0.01 + 0.99 * (i as f64 + 0.5) / n as f64;
    let column = |name: &String| -> Vec<f64> {
        let at = |i: usize| along(if name == "mu" { i % n } else { i / n });
        (0..n * n).map(|i| if name == "roughness" { at(i).sqrt() } else { at(i) }).collect()
    };
    formula.inputs().iter().map(column).collect()
}

#[inline(never)]
fn fit() -> f64 {
    let text = include_str!("../../../../fits/hypotheses/ggx_norm_n1.wgsl");
    let formula = Hypothesis::parse("ggx_norm_n1.wgsl", text).expect("a formula");
    let inputs = places(&formula, 12);
    // About an albedo, without the integrals.
    let albedo = |(alpha, mu): (&f64, &f64)| 1.0 - 0.7 * alpha * mu / (alpha + mu) - 0.3 * alpha * alpha;
    let scale: Vec<f64> = inputs[0].iter().zip(&inputs[1]).map(albedo).collect();
    let samples = Samples { target: vec![1.0; scale.len()], scale, inputs };
    let options = Options { starts: 4, ..Options::new(Goal::Max) };
    let fitted = optimise(&formula, &samples, &[], &options).expect("a fit");
    fitted.coefficients.iter().sum()
}

#[inline(never)]
fn texel_optimiser() -> f64 {
    let lattice = Lattice { size: vec![32; 2], per_cell: vec![4; 2], beyond: vec![0; 2] };
    let along = lattice.samples();
    let target = |x: f64, y: f64| 1.0 / (1.0 + 3.0 * x * x + 2.0 * x * y);
    let at = |i: usize, n: usize| i as f64 / (n - 1) as f64;
    let values = |n: [usize; 2]| -> Vec<f64> {
        (0..n[0] * n[1]).map(|i| target(at(i % n[0], n[0]), at(i / n[0], n[1]))).collect()
    };
    let targets = values([along[0], along[1]]);
    let wanted = Wanted { weights: vec![1.0; targets.len()], targets };
    texels::optimise(&lattice, &values([32; 2]), &wanted, 40).1
}

/// The formula at 128 x 128 places.
fn measured(precision: Precision) -> f64 {
    let formula = formula();
    let inputs = places(&formula, 128);
    let inputs: Vec<Vec<f32>> = inputs.iter().map(|of| of.iter().map(|x| *x as f32).collect()).collect();
    let (scale, target) = (vec![1.0; inputs[0].len()], vec![1.0; inputs[0].len()]);
    let coefficients: Vec<f32> = formula.starts().into_iter().map(|x| x as f32).collect();
    let (tape, points) = (formula.tape(), target.len());
    let found = measure_in(tape, &coefficients, &inputs, &scale, &target, points, precision);
    found.expect("finite").0.max_abs
}

#[inline(never)]
fn formula_in_f32() -> f64 {
    measured(Precision::F32)
}

#[inline(never)]
fn formula_in_f16() -> f64 {
    measured(Precision::F16)
}

#[inline(never)]
fn parse() -> f64 {
    (0..100).map(|_| black_box(formula()).inputs().len() as f64).sum()
}
