//! What a surface shows of a sky: by the lobe that a quantity of roughness is about, and by the lobe of a
//! roughness in its place.

use super::refracted::RefractedWidth;
use super::widened::{DIMENSIONS, Widened, mirrored, view};
use super::{Quantity, Variant};
use crate::integrate::IntegrateError;
use crate::integrate::monte_carlo::{refract, shadowing};
use crate::optics::ggx::{self, Vec3};
use lobefit_math::recurrence::Recurrence;
use lobefit_math::vector;

/// What a direction sends.
pub type Sky<'a> = &'a dyn Fn(Vec3) -> f64;

/// A quantity whose first output is the roughness of a lobe in place of another one. Inputs are in its
/// order; the normal is z, and the view lies at y = 0 towards x.
pub trait Seen: Sync {
    /// The mean of a sky over the lights of the lobe, by energy.
    ///
    /// # Errors
    /// None of the lights that are drawn gets anywhere; a variant that is lacking.
    fn shown(&self, variant: &Variant, x: &[f64], drawn: usize, sky: Sky) -> Result<f64, IntegrateError>;

    /// The same of the lobe of a roughness in its place.
    ///
    /// # Errors
    /// As of [`shown`](Self::shown).
    fn in_place(&self, roughness: f64, x: &[f64], drawn: usize, sky: Sky) -> Result<f64, IntegrateError>;
}

/// The mean of a sky over lights with their energy, each drawn by numbers of a sequence; NaN where none has
/// any.
fn mean(drawn: usize, light: impl Fn(&[f64; DIMENSIONS]) -> Option<(Vec3, f64)>, sky: Sky) -> f64 {
    let sequence = Recurrence::new(DIMENSIONS);
    let (mut sum, mut whole) = (0.0, 0.0);
    for i in 0..drawn {
        let draw = std::array::from_fn(|k| sequence.coordinate(i, k));
        let Some((light, energy)) = light(&draw) else { continue };
        sum += energy * sky(light);
        whole += energy;
    }
    sum / whole
}

/// A mean at inputs of a quantity, that is a number.
fn checked(quantity: &'static str, x: &[f64], mean: f64) -> Result<f64, IntegrateError> {
    if mean.is_finite() {
        Ok(mean)
    } else {
        Err(IntegrateError::NotFinite { quantity, place: format!("{x:?}") })
    }
}

impl Seen for Widened {
    fn shown(&self, _: &Variant, x: &[f64], drawn: usize, sky: Sky) -> Result<f64, IntegrateError> {
        checked(self.name(), x, mean(drawn, self.lights(x), sky))
    }

    fn in_place(&self, roughness: f64, x: &[f64], drawn: usize, sky: Sky) -> Result<f64, IntegrateError> {
        let (alpha, view) = (roughness * roughness, view(x[1]));
        checked(self.name(), x, mean(drawn, |u| mirrored(alpha, view, u[0], u[1]), sky))
    }
}

impl Seen for RefractedWidth {
    fn shown(&self, variant: &Variant, x: &[f64], drawn: usize, sky: Sky) -> Result<f64, IntegrateError> {
        let smith = variant.smith(self.name())?;
        let (alpha, view, eta) = ([x[0]; 2], view(x[1]), 1.0 / x[2]);
        let light = |u: &[f64; DIMENSIONS]| {
            let (reflectance, light) = refract(eta, view, ggx::visible_normal(alpha, view, u[0], u[1]));
            let light = light.filter(|light| light[2] < 0.0)?;
            Some((light, (1.0 - reflectance) * shadowing(smith, alpha, view, light).0))
        };
        checked(self.name(), x, mean(drawn, light, sky))
    }

    /// By a prefiltered chain: the lobe of a view along the normal, weighted by the cosine, about the
    /// refraction at the mean normal.
    fn in_place(&self, roughness: f64, x: &[f64], drawn: usize, sky: Sky) -> Result<f64, IntegrateError> {
        let (alpha, view, eta) = (roughness * roughness, view(x[1]), 1.0 / x[2]);
        let sine = eta * view[0];
        let axis = [-sine, 0.0, -(1.0 - sine * sine).sqrt()];
        let up = [0.0, 0.0, 1.0];
        let light = |u: &[f64; DIMENSIONS]| {
            let light = ggx::mirror(up, ggx::visible_normal([alpha; 2], up, u[0], u[1])).0;
            (light[2] > 0.0).then(|| (vector::turned(axis, vector::tangents(axis), light), light[2]))
        };
        checked(self.name(), x, mean(drawn, light, sky))
    }
}
