//! `beckmann-reflection`: E, A, B and loss of the isotropic Beckmann lobe.

use super::{ALPHA, Choice, Input, MU, Quantity, Variant};
use crate::integrate::monte_carlo::{self, Run, Sampled};
use crate::integrate::{IntegrateError, reflection};
use crate::optics::beckmann::Beckmann;

/// `beckmann-reflection`: `ggx-reflection` with Beckmann's distribution of normals. The error bounds the absolute error; the loss is within
/// 1e-6 of itself where mu >= 1e-4 and the loss is above 1e-12, as it falls faster than any power as alpha goes to 0.
#[derive(Clone, Copy, Debug)]
pub struct BeckmannReflection;

impl Quantity for BeckmannReflection {
    fn name(&self) -> &'static str {
        "beckmann-reflection"
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
        let smith = variant.smith(self.name())?;
        let v = reflection::reflection_of(self.name(), smith, Beckmann(x[0]), x[1], tolerance)?;
        Ok(vec![v.e, v.a, v.b, v.loss, v.error])
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        let v = monte_carlo::reflection_of(self.name(), smith, Beckmann(x[0]), x[1], run)?;
        Ok(vec![v.e, v.a, v.b, v.loss])
    }
}
