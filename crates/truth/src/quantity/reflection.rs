//! E, A, B and loss of an isotropic lobe that reflects: `ggx-reflection`, `beckmann-reflection`.

use super::{ALPHA, Choice, Input, MU, Quantity, Variant};
use crate::integrate::monte_carlo::{self, Run, Sampled};
use crate::integrate::{IntegrateError, reflection};
use crate::optics::beckmann::Beckmann;
use crate::optics::distribution::{Distribution, Ggx};

/// The directional albedo E = A + B for F = 1 of a lobe with a distribution of normals, its parts for f0 A + B, and 1 - E.
///
/// The loss is within 1e-6 of itself where mu >= 1e-4. Beckmann's falls faster than any power as alpha goes to 0, and is held to that
/// above 1e-12.
#[derive(Clone, Copy, Debug)]
pub struct Reflection<D> {
    name: &'static str,
    /// The distribution of a width.
    lobe: fn(f64) -> D,
}

/// `ggx-reflection`.
pub static GGX_REFLECTION: Reflection<Ggx> = Reflection { name: reflection::QUANTITY, lobe: Ggx };

/// `beckmann-reflection`.
pub static BECKMANN_REFLECTION: Reflection<Beckmann> =
    Reflection { name: "beckmann-reflection", lobe: Beckmann };

impl<D: Distribution> Quantity for Reflection<D> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn inputs(&self) -> &'static [Input] {
        &[ALPHA, MU]
    }

    fn outputs(&self) -> &'static [&'static str] {
        &["E", "A", "B", "loss", "error"]
    }

    fn choices(&self) -> &'static [Choice] {
        &[Choice::Smith]
    }

    fn tolerance(&self, _: &Variant) -> f64 {
        reflection::TOLERANCE
    }

    fn smallest_alpha(&self) -> f64 {
        reflection::SMALLEST_ALPHA
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let smith = variant.smith(self.name)?;
        let v = reflection::reflection_of(self.name, smith, (self.lobe)(x[0]), x[1], tolerance)?;
        Ok(vec![v.e, v.a, v.b, v.loss, v.error])
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let smith = variant.smith(self.name)?;
        let v = monte_carlo::reflection_of(self.name, smith, (self.lobe)(x[0]), x[1], run)?;
        Ok(vec![v.e, v.a, v.b, v.loss])
    }
}
