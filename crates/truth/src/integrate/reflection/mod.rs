//! `ggx-reflection`: the directional albedo of the GGX reflection lobe, its split over f0 by
//! Schlick's Fresnel, and its loss; `ggx-average`: their cosine-weighted averages.
//!
//! Ends of the domain, as limits of the integrals:
//! - alpha = 0 is the mirror: E = 1, loss = 0, B = (1 - mu)^5, A = 1 - B, E_avg = 1 (taken before
//!   mu -> 0);
//! - mu = 0, alpha > 0: the integrals themselves, which are finite; correlated E = 1 and loss = 0,
//!   separable E below 1;
//! - mu = 1: the integrals themselves; at alpha = 1, E = 1 - ln 2 (either form).
//!
//! Derivations stand in `geometry` (the azimuth in closed form) and `albedo` (the loss by the weak
//! white furnace).

mod albedo;
mod average;
mod effort;
mod geometry;
pub mod hemisphere;
mod interpolant;
mod schlick;

pub(crate) use albedo::on_one_panel;
pub use albedo::{albedo, loss};
pub use average::{Average, average};
pub use effort::Effort;
pub use interpolant::{Interpolant, Known};
pub use schlick::reflected;

use super::{Estimate, IntegrateError, PanelRule};
use crate::optics::Smith;
use crate::optics::distribution::{Distribution, Ggx};
use geometry::View;

/// Smallest alpha above 0 that is integrated; below it the lobe is a mirror to 1e-8 in E wherever
/// mu > 1e-3. The promise of 1e-10 is tested from 1e-4, and E + loss = 1 down to here.
pub const SMALLEST_ALPHA: f64 = 1e-7;

/// Smallest cosine at which the loss is held to its relative promise; below it, `error` alone
/// bounds the loss.
pub const SMALLEST_MU: f64 = 1e-4;

/// Smallest loss of a distribution with a Gaussian tail that is held to its relative promise: it
/// falls to 0 faster than any power.
pub const SMALLEST_LOSS: f64 = 1e-12;

/// The tolerance of a value by default: the promise for alpha, mu in [1e-4, 1].
pub const TOLERANCE: f64 = 1e-10;

/// Relative error promised for the loss.
pub const LOSS_TOLERANCE: f64 = 1e-6;

/// `ggx-reflection` at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflection {
    /// Directional albedo for F = 1; E = A + B.
    pub e: f64,
    /// Schlick's scale: the albedo for f0 is f0 A + B.
    pub a: f64,
    /// Schlick's bias.
    pub b: f64,
    /// 1 - E, computed directly.
    pub loss: f64,
    /// Bound on the absolute error of each of the four.
    pub error: f64,
    /// Bound on the relative error of the loss.
    pub loss_error: f64,
}

/// Integrates `ggx-reflection` at alpha in {0} or [1e-7, 1], mu in [0, 1], to an absolute
/// `tolerance`, and for mu >= 1e-4 the loss to 1e-6 relative.
///
/// Errors: an input outside its domain; a tolerance that the largest rule (64 nodes a panel) does
/// not reach.
pub fn reflection(smith: Smith, alpha: f64, mu: f64, tolerance: f64) -> Result<Reflection, IntegrateError> {
    reflection_of(QUANTITY, smith, Ggx(alpha), mu, tolerance)
}

pub(crate) const QUANTITY: &str = "ggx-reflection";

/// [`reflection`] of any distribution of normals, as the quantity of a name.
pub fn reflection_of<D: Distribution>(
    quantity: &'static str,
    smith: Smith,
    lobe: D,
    mu: f64,
    tolerance: f64,
) -> Result<Reflection, IntegrateError> {
    let alpha = lobe.alpha();
    check_inputs(quantity, alpha, mu)?;
    if alpha == 0.0 {
        return Ok(mirror(smith, lobe, mu));
    }
    let mut reached = f64::INFINITY;
    for pair in Effort::ladder().windows(2) {
        let value = of_pair(quantity, &View::new(smith, lobe, mu), &pair[0], &pair[1])?;
        reached = value.error;
        let negligible = D::REACH.is_finite() && value.loss < SMALLEST_LOSS || !D::MATCHED;
        let loss_kept = value.loss_error <= LOSS_TOLERANCE || mu < SMALLEST_MU || negligible;
        if value.error <= tolerance && loss_kept {
            return Ok(value);
        }
    }
    Err(IntegrateError::Tolerance {
        quantity,
        place: format!("alpha = {alpha:?}, mu = {mu:?}"),
        reached,
        tolerance,
    })
}

/// The split albedo (E, B) by one rule, without an error bound: for fields of many points whose
/// rule was checked. alpha in {0} or [1e-7, 1], mu in [0, 1]; B costs some fifty times E.
pub fn split(smith: Smith, alpha: f64, mu: f64, effort: &Effort) -> (f64, f64) {
    split_of(smith, Ggx(alpha), mu, effort)
}

/// [`split`] of any distribution of normals.
pub fn split_of<D: Distribution>(smith: Smith, lobe: D, mu: f64, effort: &Effort) -> (f64, f64) {
    if lobe.alpha() == 0.0 {
        let value = mirror(smith, lobe, mu);
        return (value.e, value.b);
    }
    let view = View::new(smith, lobe, mu);
    (albedo::kept(&view, &effort.outer), schlick::bias(&view, effort))
}

/// E alone of any distribution of normals, by one rule.
pub(crate) fn albedo_of<D: Distribution>(smith: Smith, lobe: D, mu: f64, rule: &PanelRule) -> f64 {
    match lobe.alpha() {
        0.0 => mirror(smith, lobe, mu).e,
        _ => albedo::kept(&View::new(smith, lobe, mu), rule),
    }
}

/// Values of the finer effort with bounds from the pair; alpha > 0.
pub fn at_effort(
    smith: Smith,
    alpha: f64,
    mu: f64,
    coarse: &Effort,
    fine: &Effort,
) -> Result<Reflection, IntegrateError> {
    of_pair(QUANTITY, &View::new(smith, Ggx(alpha), mu), coarse, fine)
}

fn of_pair<D: Distribution>(
    quantity: &'static str,
    view: &View<D>,
    coarse: &Effort,
    fine: &Effort,
) -> Result<Reflection, IntegrateError> {
    let (alpha, mu) = (view.lobe.alpha(), view.mu);
    // An integrand with a Gaussian tail has no nearest singularity, and twice the nodes need not
    // square the error.
    let estimate = if D::REACH.is_finite() { Estimate::from_slow_pair } else { Estimate::from_pair };
    let pair = |f: &dyn Fn(&Effort) -> f64, scale: f64| estimate(f(coarse), f(fine), scale);
    let e = pair(&|effort| albedo::kept(view, &effort.outer), 1.0);
    let b = pair(&|effort| schlick::bias(view, effort), 1.0);
    // Without a weak white furnace the loss is what E leaves of 1.
    let lost = |effort: &Effort| match D::MATCHED {
        true => albedo::lost(view, &effort.outer),
        false => 1.0 - albedo::kept(view, &effort.outer),
    };
    let fine_loss = lost(fine);
    let scale = if fine_loss > 0.0 { fine_loss } else { 1.0 };
    let loss = estimate(lost(coarse), fine_loss, scale);
    // Nodes carry eps of absolute rounding in a variable where the horizon's layer is as wide as
    // the smaller of alpha and mu.
    let rounding = 4.0 * f64::EPSILON / if mu > 0.0 { mu.min(alpha) } else { alpha };
    let value = Reflection {
        e: e.value,
        a: e.value - b.value,
        b: b.value,
        loss: loss.value,
        error: (e.error + b.error).max(loss.error),
        loss_error: loss.error / scale + rounding,
    };
    if [value.e, value.b, value.loss, value.error].iter().all(|x| x.is_finite()) {
        Ok(value)
    } else {
        let place = format!("alpha = {alpha:?}, mu = {mu:?}");
        Err(IntegrateError::NotFinite { quantity, place })
    }
}

/// alpha = 0: a mirror, which Smith's own masking leaves whole; E is G2 of its direction.
fn mirror<D: Distribution>(smith: Smith, lobe: D, mu: f64) -> Reflection {
    let area = lobe.area_at(mu);
    let hidden = !D::MATCHED && area > mu;
    let e = if hidden { mu * smith.shadowing_over_cosine(mu, area, mu, area) } else { 1.0 };
    let weight = crate::optics::fresnel::schlick_weight(1.0 - mu);
    let b = e * weight;
    Reflection { e, a: e - b, b, loss: 1.0 - e, error: 0.0, loss_error: 0.0 }
}

/// Refuses alpha outside {0} or [1e-7, 1] and mu outside [0, 1].
pub(in crate::integrate) fn check_inputs(
    quantity: &'static str,
    alpha: f64,
    mu: f64,
) -> Result<(), IntegrateError> {
    let inside = alpha == 0.0 || (SMALLEST_ALPHA..=1.0).contains(&alpha);
    let inputs = [
        ("alpha", alpha, inside, "is neither 0 nor in [1e-7, 1]"),
        ("mu", mu, (0.0..=1.0).contains(&mu), "is outside [0, 1]"),
    ];
    IntegrateError::outside(quantity, inputs)
}
