//! The albedo of any isotropic BRDF: the truth of a quantity for which nobody has derived a shorter
//! integral.

use super::reflection::Effort;
use super::reflection::hemisphere::Hemisphere;
use super::{Estimate, Goal, IntegrateError};
use crate::optics::ggx::Vec3;

/// An isotropic BRDF with what its integrals must know of it.
pub struct Brdf<'a> {
    /// f(view, light) cos(theta_light) of unit directions above the surface, whose normal is z.
    pub weighted: Box<dyn Fn(Vec3, Vec3) -> f64 + Sync + 'a>,
    /// Width alpha in [1e-7, 1] of its narrowest peak about the mirror direction; 1e-3 where it has
    /// a kink there, 1 where it is smooth. Panels are graded from the mirror direction outwards, so
    /// that wider lobes beside it are resolved too.
    pub width: f64,
}

/// Smallest cosine of a view: a BRDF has 0/0 at 0.
pub const SMALLEST_MU: f64 = 1e-6;

/// Integrates the BRDF of a quantity over the lights of a view at mu in [1e-6, 1], to an absolute
/// `tolerance`. The error is the difference of two rules of which one has twice the nodes.
///
/// # Errors
/// A cosine outside the domain; a tolerance that the largest rule does not reach.
pub fn albedo(
    quantity: &'static str,
    brdf: &Brdf,
    mu: f64,
    tolerance: f64,
) -> Result<Estimate, IntegrateError> {
    let domain = "is outside [1e-6, 1], where a BRDF is integrated";
    IntegrateError::outside(quantity, [("mu", mu, (SMALLEST_MU..=1.0).contains(&mu), domain)])?;
    let by = |effort: &Effort| {
        let hemisphere = Hemisphere::new(brdf.width, mu, effort);
        let [sum] = hemisphere.integrate(|_, light| [(brdf.weighted)(hemisphere.view, *light)]);
        Ok(sum)
    };
    // Of a function of which nothing is known: the difference itself, however much smaller the error of
    // the finer rule is.
    let bounded = |coarse: &f64, fine: &f64| {
        let error = (fine - coarse).abs();
        error.is_finite().then_some((Estimate { value: *fine, error }, error))
    };
    Goal { quantity, place: &|| format!("mu = {mu:?}"), tolerance }.climb(Effort::ladder(), by, bounded)
}
