//! `ggx-average`: the cosine-weighted average of E, and its loss.

use super::{ALPHA, Choice, Input, Quantity, Variant};
use crate::integrate::monte_carlo::{self, Run, Sampled};
use crate::integrate::{IntegrateError, reflection};

/// `ggx-average`: E_avg = 2 int_0^1 E(mu) mu dmu and 1 - E_avg.
#[derive(Clone, Copy, Debug)]
pub struct GgxAverage;

impl Quantity for GgxAverage {
    fn name(&self) -> &'static str {
        "ggx-average"
    }

    fn inputs(&self) -> &'static [Input] {
        &[ALPHA]
    }

    fn outputs(&self) -> &'static [&'static str] {
        &["E_avg", "loss_avg", "error"]
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
        let v = reflection::average(variant.smith(self.name())?, x[0], tolerance)?;
        Ok(vec![v.e_avg, v.loss_avg, v.error])
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let (e, loss) = monte_carlo::average(variant.smith(self.name())?, x[0], run)?;
        Ok(vec![e, loss])
    }
}
