//! How far what is looked up is from what it stands for, in one number: what every part of the
//! study states.

use lobefit_math::vector::{Vec3, dot, minus};
use lobefit_math::{ops, sum};

/// Root of the sum of squares of the differences of what is found from the truth over that of the
/// truth, over channels and points: relative L2. NaN of no points.
pub(super) fn relative(found: &[Vec3], truth: &[Vec3]) -> f64 {
    let pair = |(found, truth): (&Vec3, &Vec3)| {
        let off = minus(*found, *truth);
        (dot(off, off), dot(*truth, *truth))
    };
    let (errors, sizes): (Vec<f64>, Vec<f64>) = found.iter().zip(truth).map(pair).unzip();
    (sum::pairwise(&errors) / sum::pairwise(&sizes)).sqrt()
}

/// The geometric mean of positive numbers, NaN of none: of errors, and of how many times smaller
/// one is than another's.
pub(super) fn geometric_mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let logarithms: Vec<f64> = values.into_iter().map(ops::log).collect();
    ops::exp(sum::mean(&logarithms))
}

/// How many times smaller errors are than those of a rival at the same places: the geometric mean
/// of the ratios.
pub(super) fn gain(rival: &[f64], own: &[f64]) -> f64 {
    geometric_mean(rival.iter().zip(own).map(|(rival, own)| rival / own))
}
