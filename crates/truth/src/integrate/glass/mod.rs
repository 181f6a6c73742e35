//! `ggx-glass`, `beckmann-glass`: energy that a rough dielectric interface reflects (R) and transmits (T),
//! from either side, with exact Fresnel and total internal reflection. Isotropic; energy, so no 1/eta^2; a
//! ray that leaves on the wrong side counts 0.
//!
//! Facets are swept in polar coordinates about the view: the angle theta_d between view and facet
//! normal, on which Fresnel, the half angle of the reflection and the deviation of the refraction
//! depend alone (`sweep`), and the azimuth psi about the view, in which the heights of facet,
//! mirrored and refracted direction are all linear in cos(psi) (`ring`).
//!
//! Ends of the domain: alpha = 0 is the smooth interface, R = F(mu), T = 1 - F(mu). ior = 1 has
//! R = 0 and T = G2/G1 of the straight-through direction: (1 + L)/(1 + 2 L) for the correlated form
//! and 1/(1 + L) for the separable one, not 1.

mod facets;
mod interface;
mod ring;
mod sweep;
pub mod table;

pub use facets::Facets;
pub use interface::Side;

use super::{Estimate, Goal, IntegrateError, PanelRule};
use crate::optics::Smith;
use crate::optics::distribution::Ggx;
pub(super) use interface::Interface;

/// Range of alpha, beside 0.
pub const ALPHA: [f64; 2] = [1e-4, 1.0];

/// Smallest cosine: at grazing the polar form about the view has no facets' plane to turn about.
pub const SMALLEST_MU: f64 = 1e-6;

/// Largest index of refraction.
pub const LARGEST_IOR: f64 = 4.0;

/// Tolerance of a value by default: the promise for alpha and mu in [1e-3, 1] and ior
/// in [1, 3].
pub const TOLERANCE: f64 = 1e-8;

/// `ggx-glass` at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glass {
    /// Reflected energy.
    pub r: f64,
    /// Transmitted energy.
    pub t: f64,
    /// R + T.
    pub e: f64,
    /// 1 - E, computed directly.
    pub loss: f64,
    /// Bound on the absolute error of each of the four.
    pub error: f64,
    /// Bound on the relative error of the loss.
    pub loss_error: f64,
}

const QUANTITY: &str = "ggx-glass";

/// Rounding of the sums in units of a single one's.
const ROUNDING: f64 = 4.0;

/// Integrates `ggx-glass` at alpha in {0} or [1e-4, 1], mu in [1e-6, 1] and
/// ior = n_inside/n_outside in [1, 4]; `side` is where the ray comes from.
pub fn glass(
    smith: Smith,
    alpha: f64,
    mu: f64,
    ior: f64,
    side: Side,
    tolerance: f64,
) -> Result<Glass, IntegrateError> {
    glass_of(QUANTITY, (smith, Ggx(alpha)), mu, (ior, side), tolerance)
}

/// [`glass`] of any distribution of normals.
pub(crate) fn glass_of<D: Facets>(
    quantity: &'static str,
    (smith, lobe): (Smith, D),
    mu: f64,
    (ior, side): (f64, Side),
    tolerance: f64,
) -> Result<Glass, IntegrateError> {
    let alpha = lobe.alpha();
    check(quantity, alpha, mu, ior)?;
    let interface = Interface::new(ior, side);
    if alpha == 0.0 {
        return Ok(smooth(interface, mu));
    }
    let values = |n| sweep::energies(smith, lobe, mu, interface, &PanelRule::new(n));
    let place = || format!("alpha = {alpha:?}, mu = {mu:?}, ior = {ior:?}, {}", side.name());
    refined((quantity, &place), values, ROUNDING, tolerance)
}

/// The smooth interface.
pub(super) fn smooth(interface: Interface, mu: f64) -> Glass {
    let r = interface.fresnel(mu);
    Glass { r, t: 1.0 - r, e: 1.0, loss: 0.0, error: f64::EPSILON, loss_error: 0.0 }
}

/// R, T and loss by rules of more and more nodes until they are within the tolerance.
pub(super) fn refined(
    (quantity, place): (&'static str, &dyn Fn() -> String),
    values: impl Fn(usize) -> [f64; 3],
    rounding: f64,
    tolerance: f64,
) -> Result<Glass, IntegrateError> {
    Goal { quantity, place, tolerance }.climb(
        [8, 16, 32, 64],
        |n| Ok(values(n)),
        |coarse, fine| bounded(*coarse, *fine, rounding).map(|value| (value, value.error)),
    )
}

/// Refuses inputs outside the domain.
pub(super) fn check(quantity: &'static str, alpha: f64, mu: f64, ior: f64) -> Result<(), IntegrateError> {
    // A roughness rounded to f32 may make an alpha just below the least.
    let least = ALPHA[0] * (1.0 - 1e-6);
    let inside = alpha == 0.0 || (least..=ALPHA[1]).contains(&alpha);
    let inputs = [
        ("alpha", alpha, inside, "is neither 0 nor in [1e-4, 1]"),
        ("mu", mu, (SMALLEST_MU..=1.0).contains(&mu), "is outside [1e-6, 1]"),
        ("ior", ior, (1.0..=LARGEST_IOR).contains(&ior), "is outside [1, 4]"),
    ];
    IntegrateError::outside(quantity, inputs)
}

/// The values by one rule of `n` nodes a panel, as their own bound: for checks of the bound.
pub fn with_nodes(
    smith: Smith,
    alpha: f64,
    mu: f64,
    ior: f64,
    side: Side,
    n: usize,
) -> Result<Glass, IntegrateError> {
    check(QUANTITY, alpha, mu, ior)?;
    let values = sweep::energies(smith, Ggx(alpha), mu, Interface::new(ior, side), &PanelRule::new(n));
    let place = || format!("alpha = {alpha:?}, mu = {mu:?}, ior = {ior:?}");
    bounded(values, values, ROUNDING)
        .ok_or_else(|| IntegrateError::NotFinite { quantity: QUANTITY, place: place() })
}

/// Values of the finer rule with bounds from the pair, where they are finite.
fn bounded(coarse: [f64; 3], fine: [f64; 3], rounding: f64) -> Option<Glass> {
    let estimate = |i: usize, scale: f64| {
        Estimate::from_slow_pair(coarse[i], fine[i], scale).with_rounding(rounding, scale)
    };
    let (r, t) = (estimate(0, 1.0), estimate(1, 1.0));
    let scale = if fine[2] > 0.0 { fine[2] } else { 1.0 };
    let loss = estimate(2, scale);
    let value = Glass {
        r: r.value,
        t: t.value,
        e: r.value + t.value,
        loss: loss.value,
        error: (r.error + t.error).max(loss.error),
        loss_error: loss.error / scale,
    };
    [value.e, value.loss, value.error].iter().all(|x| x.is_finite()).then_some(value)
}
