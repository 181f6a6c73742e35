//! What the fetches of a rule are expected to be off by.

use rayon::prelude::*;

use super::fit::Situation;
use super::least::least;
use super::rule::TapRule;
use lobefit_math::ops;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::optics::footprint::Stretch;
use lobefit_truth::quantity::footprint::slant::Normal;

/// The formula of an expected total variation and how far off it is.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Expected {
    /// p, s, q, r of the root of (p l/(1 + s l))^2 + (q g/(1 + r g))^2, l the logarithm of the
    /// footprint's length over its width, g = alpha [`Stretch::growth`]. Least squares over the
    /// 1600 walls of seed 3.
    pub constants: [f64; 4],
    /// Largest root mean square error at any width up to each of [`EXPECTED_UP_TO`], over the 1600
    /// of seed 5. Wide lobes of which much misses the wall have no third input that would tell.
    pub off: [f64; 2],
}

/// Widths up to which [`Expected::off`] is stated; it starts at 0.01.
pub const EXPECTED_UP_TO: [f64; 2] = [0.1, 0.8];

/// The root of the sum of the squares of the part of the stretch and that of the growth, at most 1.
pub(super) fn variation([p, s, q, r]: &[f64; 4], stretch: &Stretch, alpha: f64) -> f64 {
    let z = stretch.length;
    // ln of length over width, z^2 = 1 - 1/l^2
    let stretched = -0.5 * ops::log1p(-(z * z).min(1.0 - f64::EPSILON));
    let grown = alpha * stretch.growth;
    let (even, odd) = (p * stretched / (1.0 + s * stretched), q * grown / (1.0 + r * grown));
    (even * even + odd * odd).sqrt().min(1.0)
}

/// Constants of an expected total variation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// As those of [`Expected`].
    pub constants: [f64; 4],
    /// Root mean square error, of the start and in the end.
    pub off: [f64; 2],
}

/// Step of a difference of constants.
const STEP: f64 = 1e-6;

/// The constants that serve the situations best, by least squares from a start as of [`Expected`].
///
/// # Errors
/// A solver that fails; no situation.
pub fn expected(
    rule: &TapRule,
    start: &[f64; 4],
    situations: &[Situation],
    iterations: u64,
) -> Result<Expectation, IntegrateError> {
    let truth: Vec<f64> = situations.par_iter().map(|situation| situation.variation(rule)).collect();
    let residuals = |constants: &[f64; 4]| -> Vec<f64> {
        let of = |(s, tv): (&Situation, &f64)| variation(constants, &s.case.stretch, s.case.alpha) - tv;
        situations.iter().zip(&truth).map(of).collect()
    };
    let squares = |constants: &[f64]| -> Option<Normal> {
        let constants: [f64; 4] = constants.try_into().ok()?;
        let here = residuals(&constants);
        let mut columns = Vec::new();
        for j in 0..constants.len() {
            let mut moved = constants;
            moved[j] += STEP;
            columns.push(residuals(&moved).iter().zip(&here).map(|(a, b)| (a - b) / STEP).collect());
        }
        Normal::of(&here, &columns)
    };
    let found = least(squares, start, iterations)?;
    let not_finite = || IntegrateError::NotFinite {
        quantity: "expected variation",
        place: format!("constants {:?}", found.at),
    };
    let at: [f64; 4] = found.at.as_slice().try_into().map_err(|_| not_finite())?;
    let off = |constants: &[f64; 4]| {
        let sum: f64 = residuals(constants).iter().map(|r| r * r).sum();
        (sum / truth.len().max(1) as f64).sqrt()
    };
    Ok(Expectation { constants: at, off: [off(start), off(&at)] })
}
