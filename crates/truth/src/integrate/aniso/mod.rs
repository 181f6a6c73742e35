//! `ggx-reflection-aniso`: E and its loss of the anisotropic GGX reflection lobe, at a fixed
//! azimuth of the view or averaged over it.
//!
//! In slope space the facets that reflect above the horizon form a disc of radius 1/mu about the
//! point where the view's own slope lies; it contains the macro normal, so it is star-shaped about
//! it, and its edge is a closed form that does not depend on alpha. The integral runs along rays
//! from the macro normal (`ray`) and over their azimuth (`rays`).

mod average;
pub mod fast;
pub mod glass;
mod ray;
mod rays;
mod view;

use super::{Estimate, Goal, IntegrateError, PanelRule};
use crate::optics::Smith;
use rays::Rays;
use view::View;

/// Range of alpha_x and alpha_y, beside both 0.
pub const ALPHA: [f64; 2] = [1e-4, 4.0];

/// Tolerance of a value by default: the promise for alpha_x, alpha_y in [1e-3, 3] with
/// ratio up to 1:100 and mu in [1e-3, 1].
pub const TOLERANCE: f64 = 1e-9;

/// `ggx-reflection-aniso` at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aniso {
    /// Directional albedo for F = 1.
    pub e: f64,
    /// 1 - E, computed directly.
    pub loss: f64,
    /// Bound on the absolute error of both.
    pub error: f64,
    /// Bound on the relative error of the loss.
    pub loss_error: f64,
}

/// Integrates E and the loss at alpha_x, alpha_y in [1e-4, 4] (or both 0: the mirror), mu in [0, 1]
/// and the azimuth phi of the view from the alpha_x axis, radians; without phi, the mean over it.
pub fn aniso(
    smith: Smith,
    alpha: [f64; 2],
    mu: f64,
    phi: Option<f64>,
    tolerance: f64,
) -> Result<Aniso, IntegrateError> {
    check(QUANTITY, alpha, mu, phi)?;
    if alpha == [0.0, 0.0] {
        return Ok(Aniso { e: 1.0, loss: 0.0, error: 0.0, loss_error: 0.0 });
    }
    let goal = Goal { quantity: QUANTITY, place: &|| place(alpha, mu), tolerance };
    goal.climb(
        [8, 16, 32, 64],
        |n| Ok(values(smith, alpha, mu, phi, n)),
        |coarse, fine| bounded(*coarse, *fine).map(|value| (value, value.error)),
    )
}

/// Rounding of the nested sums in units of a single one's: a floor of 2e-11, a fiftieth of the
/// promise.
const FLOOR: f64 = 300.0;

const QUANTITY: &str = "ggx-reflection-aniso";

/// Refuses inputs outside the domain.
pub(super) fn check(
    quantity: &'static str,
    alpha: [f64; 2],
    mu: f64,
    phi: Option<f64>,
) -> Result<(), IntegrateError> {
    let inside = |a: f64| (ALPHA[0]..=ALPHA[1]).contains(&a) || alpha == [0.0, 0.0];
    let domain = "is not in [1e-4, 4] (or both alphas 0)";
    let phi = phi.unwrap_or(0.0);
    let inputs = [
        ("alpha_x", alpha[0], inside(alpha[0]), domain),
        ("alpha_y", alpha[1], inside(alpha[1]), domain),
        ("mu", mu, (0.0..=1.0).contains(&mu), "is outside [0, 1]"),
        ("phi", phi, phi.is_finite(), "is not finite"),
    ];
    IntegrateError::outside(quantity, inputs)
}

/// The values by one rule of `n` nodes a panel, as their own bound: for checks of the bound.
pub fn with_nodes(
    smith: Smith,
    alpha: [f64; 2],
    mu: f64,
    phi: f64,
    n: usize,
) -> Result<Aniso, IntegrateError> {
    check(QUANTITY, alpha, mu, Some(phi))?;
    let values = values(smith, alpha, mu, Some(phi), n);
    bounded(values, values).ok_or_else(|| not_finite(alpha, mu))
}

/// Cosine below which a view is at grazing: E differs from its limit by less than its rounding, and a
/// layer that thin is no scale to grade panels to.
const GRAZING: f64 = 1e-30;

/// E and the loss by rules of `n` nodes a panel, along rays and over their azimuth.
fn values(smith: Smith, alpha: [f64; 2], mu: f64, phi: Option<f64>, n: usize) -> [f64; 2] {
    let (rule, mu) = (PanelRule::new(n), if mu < GRAZING { 0.0 } else { mu });
    match phi {
        Some(phi) => Rays::new(View::new(smith, alpha, mu, phi)).albedo(&rule),
        None => average::mean(smith, alpha, mu, &rule),
    }
}

/// Values of the finer rules with bounds from the pair, where they are finite.
fn bounded(coarse: [f64; 2], fine: [f64; 2]) -> Option<Aniso> {
    let e = Estimate::from_slow_pair(coarse[0], fine[0], 1.0).with_rounding(FLOOR, 1.0);
    let scale = if fine[1] > 0.0 { fine[1] } else { 1.0 };
    let loss = Estimate::from_slow_pair(coarse[1], fine[1], scale).with_rounding(FLOOR, scale);
    let error = e.error.max(loss.error);
    let value = Aniso { e: e.value, loss: loss.value, error, loss_error: loss.error / scale };
    (value.e.is_finite() && value.loss.is_finite()).then_some(value)
}

fn not_finite(alpha: [f64; 2], mu: f64) -> IntegrateError {
    IntegrateError::NotFinite { quantity: QUANTITY, place: place(alpha, mu) }
}

fn place(alpha: [f64; 2], mu: f64) -> String {
    format!("alpha_x = {:?}, alpha_y = {:?}, mu = {mu:?}", alpha[0], alpha[1])
}
