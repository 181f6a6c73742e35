//! The values of f0 that stand for all.

use super::Span;
use crate::math::chebyshev;

/// How the values of f0 are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    /// For a mean square that is fitted.
    Even,
    /// For the largest error that is fitted.
    Edged,
    /// For a mean square that is measured.
    MeasuredMean,
    /// For the largest error that is measured.
    Measured,
}

/// Values of f0 where the error is not affine in it, by [`Choice`]: midpoints, Chebyshev nodes, other midpoints, an even lattice with
/// both ends.
const EVEN: usize = 8;
const EDGED: usize = 9;
const MEAN: usize = 7;
const LATTICE: usize = 17;

/// The values: for an error that is affine in f0 the two Gauss nodes, which give the exact mean square, or the two ends, where the
/// error is largest.
pub(super) fn values(span: &Span, affine: bool, choice: Choice) -> Vec<f64> {
    let [low, high] = span.range;
    let at = |t: f64| low + (high - low) * t;
    if low == high {
        return vec![low];
    }
    let midpoints = |n: usize| (0..n).map(|i| at((i as f64 + 0.5) / n as f64)).collect();
    match (choice, affine) {
        (Choice::Even | Choice::MeasuredMean, true) => {
            let offset = 0.5 / 3.0_f64.sqrt();
            vec![at(0.5 - offset), at(0.5 + offset)]
        }
        (Choice::Edged | Choice::Measured, true) => vec![low, high],
        (Choice::Even, false) => midpoints(EVEN),
        (Choice::MeasuredMean, false) => midpoints(MEAN),
        (Choice::Edged, false) => chebyshev::nodes(low, high, EDGED),
        (Choice::Measured, false) => (0..LATTICE)
            .map(|i| if i + 1 == LATTICE { high } else { at(i as f64 / (LATTICE - 1) as f64) })
            .collect(),
    }
}
