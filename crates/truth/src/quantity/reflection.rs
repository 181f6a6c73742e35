//! `ggx-reflection`: E, A, B and loss of the isotropic GGX lobe.

use super::{ALPHA, Choice, Input, MU, Quantity, Variant};
use crate::integrate::monte_carlo::{self, Run, Sampled};
use crate::integrate::{IntegrateError, reflection};

/// `ggx-reflection`: the directional albedo E = A + B for F = 1, its parts for f0 A + B, and 1 - E.
#[derive(Clone, Copy, Debug)]
pub struct GgxReflection;

impl Quantity for GgxReflection {
    fn name(&self) -> &'static str {
        "ggx-reflection"
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
        let v = reflection::reflection(variant.smith(self.name())?, x[0], x[1], tolerance)?;
        Ok(vec![v.e, v.a, v.b, v.loss, v.error])
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let v = monte_carlo::reflection(variant.smith(self.name())?, x[0], x[1], run)?;
        Ok(vec![v.e, v.a, v.b, v.loss])
    }
}
