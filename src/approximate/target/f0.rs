//! The values of f0 that stand for all.

use super::Span;
use lobefit_math::chebyshev;

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

/// Panels of the rules for means where the error is not affine in f0: samples have no weights of
/// their own, so that all nodes weigh the same, as in Chebyshev's quadrature (Abramowitz & Stegun,
/// 25.4.28). Midpoints in their place are off by a percent where a p-norm is weighted by f0.
const EVEN: usize = 2;
const MEAN: usize = 3;

/// Values of f0 for the largest error there: Chebyshev's extrema, and an even lattice with both
/// ends.
const EDGED: usize = 9;
const LATTICE: usize = 17;

/// The values: for an error that is affine in f0 the two Gauss nodes, which give the exact mean
/// square, or the two ends, where the error is largest.
pub(super) fn values(span: &Span, affine: bool, choice: Choice) -> Vec<f64> {
    let [low, high] = span.range;
    let at = |t: f64| low + (high - low) * t;
    if low == high {
        return vec![low];
    }
    let panels = |n: usize, nodes: &[f64]| -> Vec<f64> {
        let panel = |i: usize| nodes.iter().map(move |x| (i as f64 + 0.5 + 0.5 * x) / n as f64);
        (0..n).flat_map(panel).map(at).collect()
    };
    // x^2 = (sqrt 5 -+ 2)/(3 sqrt 5), exact for degree 5; and 1/sqrt 2, for degree 3.
    let root = 5.0_f64.sqrt();
    let [inner, outer] = [root - 2.0, root + 2.0].map(|x| (x / (3.0 * root)).sqrt());
    let half = 0.5_f64.sqrt();
    match (choice, affine) {
        (Choice::Even | Choice::MeasuredMean, true) => {
            let offset = 0.5 / 3.0_f64.sqrt();
            vec![at(0.5 - offset), at(0.5 + offset)]
        }
        (Choice::Edged | Choice::Measured, true) => vec![low, high],
        (Choice::Even, false) => panels(EVEN, &[-outer, -inner, inner, outer]),
        (Choice::MeasuredMean, false) => panels(MEAN, &[-half, 0.0, half]),
        (Choice::Edged, false) => chebyshev::nodes(low, high, EDGED),
        (Choice::Measured, false) => (0..LATTICE)
            .map(|i| if i + 1 == LATTICE { high } else { at(i as f64 / (LATTICE - 1) as f64) })
            .collect(),
    }
}
