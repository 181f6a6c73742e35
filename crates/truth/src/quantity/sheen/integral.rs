//! `sheen-charlie`: the directional albedo of the sheen lobe of [`lobe`](super::lobe).
//!
//! Ends of the domain, as limits of the integral:
//! - mu = 0: E = (2 + p)/(2 sqrt(pi)) Gamma((p + 3)/2)/Gamma((p + 4)/2), p = 1/alpha, about
//!   sqrt(p/(2 pi)): above 1 for alpha below 0.2 and without bound as alpha -> 0. The lobe is not
//!   energy conserving there, and E is not clamped;
//! - mu = 1: E = 2^-(p/2 + 1)/(p/2 + 2);
//! - alpha -> 0 at fixed mu > 0: E -> 0, faster than any power; it is refused at alpha = 0, where E
//!   has no value at mu = 0.
//!
//! The derivation stands in `facets`.

use std::sync::LazyLock;

use super::facets::View;
use super::lobe::exponent;
use crate::integrate::{Estimate, Goal, IntegrateError, PanelRule};

/// Smallest alpha: D's exponent is 1e6, and E at mu = 0 is 399.
pub const SMALLEST_ALPHA: f64 = 1e-6;

/// The tolerance of a value by default: the promise over the whole domain.
pub const TOLERANCE: f64 = 1e-10;

/// `sheen-charlie` at a point.
pub type Sheen = Estimate;

/// Integrates `sheen-charlie` at alpha in [1e-6, 1], mu in [0, 1], to an absolute `tolerance`. E
/// may exceed 1.
///
/// The bound is a relative one too (1e-12 of E or better) until E leaves the range of numbers below
/// 1e-300.
///
/// Errors: an input outside its domain; a tolerance that the largest rule (64 nodes a panel) does
/// not reach.
pub fn sheen(alpha: f64, mu: f64, tolerance: f64) -> Result<Sheen, IntegrateError> {
    check(alpha, mu)?;
    let view = View::new(alpha, mu);
    let bounded = |coarse: &f64, fine: &f64| {
        let value = bounded(*coarse, *fine, view.exponent());
        fine.is_finite().then_some((value, value.error))
    };
    let place = || format!("alpha = {alpha:?}, mu = {mu:?}");
    let goal = Goal { quantity: "sheen-charlie", place: &place, tolerance };
    goal.climb(ladder(), |rule| Ok(view.albedo(rule)), bounded)
}

/// E by the rule of 16 nodes a panel, without an error bound: for fields of many points. Inputs as
/// for [`sheen`]; within 1e-11 of E relative (tested).
pub fn albedo(alpha: f64, mu: f64) -> f64 {
    View::new(alpha, mu).albedo(&ladder()[1])
}

/// Refuses inputs outside the domain.
pub(super) fn check(alpha: f64, mu: f64) -> Result<(), IntegrateError> {
    let inputs = [
        ("alpha", alpha, (SMALLEST_ALPHA..=1.0).contains(&alpha), "is outside [1e-6, 1]"),
        ("mu", mu, (0.0..=1.0).contains(&mu), "is outside [0, 1]"),
    ];
    IntegrateError::outside("sheen-charlie", inputs)
}

/// The finer of two values. Its rounding is relative, and that of the factor e^-x which sets its
/// size is x eps more.
fn bounded(coarse: f64, fine: f64, exponent: f64) -> Estimate {
    if fine < f64::MIN_POSITIVE {
        return Estimate { value: fine, error: 2.0 * f64::MIN_POSITIVE };
    }
    let value = Estimate::from_pair(coarse, fine, fine);
    Estimate { error: value.error + 2.0 * exponent * f64::EPSILON * fine, ..value }
}

/// Rules of 8, 16, 32 and 64 nodes a panel.
fn ladder() -> &'static [PanelRule; 4] {
    static LADDER: LazyLock<[PanelRule; 4]> = LazyLock::new(|| [8, 16, 32, 64].map(PanelRule::new));
    &LADDER
}

/// (2 + p) times the mass of sin^(p + 1) over [0, pi/2], p = 1/alpha: the mean of the rest of the
/// integrand times this is E.
pub(super) fn mass(alpha: f64) -> f64 {
    use lobefit_math::ops;
    let p = exponent(alpha);
    let ratio = ops::lgamma(0.5 * p + 1.0) - ops::lgamma(0.5 * p + 1.5);
    0.5 * (2.0 + p) * std::f64::consts::PI.sqrt() * ops::exp(ratio)
}
