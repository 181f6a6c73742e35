//! The kernel for the instructions that the processor has. Every path does the same operations in
//! the same order (nothing is contracted), so all give the same bits.

use multiversion::multiversion;

use super::kernel;
use super::rules::RaysRule;
use crate::integrate::Path;
use crate::integrate::aniso::view::View;

/// E at one azimuth.
pub(super) fn rays(path: Path, view: &View, rule: &RaysRule) -> f64 {
    match path {
        Path::Best => best(view, rule),
        Path::Avx2 => avx2(view, rule),
        Path::Baseline => baseline(view, rule),
    }
}

#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
fn best(view: &View, rule: &RaysRule) -> f64 {
    kernel::rays(view, rule)
}

#[multiversion(targets("x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"))]
fn avx2(view: &View, rule: &RaysRule) -> f64 {
    kernel::rays(view, rule)
}

fn baseline(view: &View, rule: &RaysRule) -> f64 {
    kernel::rays(view, rule)
}

/// The sum of `from`'s rows, each as long as `to`, by their weights.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
pub(super) fn combine(weights: &[f64], from: &[f64], to: &mut [f64]) {
    for (weight, row) in weights.iter().zip(from.chunks_exact(to.len())) {
        for (sum, x) in to.iter_mut().zip(row) {
            *sum += weight * x;
        }
    }
}
