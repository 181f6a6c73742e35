//! `sheen-charlie`: E of the sheen lobe.

use super::{Choice, Input, MU, Quantity, Variant};
use crate::integrate::monte_carlo::{self, Run, Sampled};
use crate::integrate::{IntegrateError, sheen};

/// `sheen-charlie`: the directional albedo of Charlie's distribution with Neubelt's visibility, which has no Smith form.
#[derive(Clone, Copy, Debug)]
pub struct SheenCharlie;

impl Quantity for SheenCharlie {
    fn name(&self) -> &'static str {
        "sheen-charlie"
    }

    fn inputs(&self) -> &'static [Input] {
        const { &[Input::new("alpha", [sheen::SMALLEST_ALPHA, 1.0]), MU] }
    }

    fn outputs(&self) -> &'static [&'static str] {
        &["E", "error"]
    }

    fn choices(&self) -> &'static [Choice] {
        &[]
    }

    fn tolerance(&self, _: &Variant) -> f64 {
        sheen::TOLERANCE
    }

    fn smallest_alpha(&self) -> f64 {
        sheen::SMALLEST_ALPHA
    }

    fn remark(&self) -> &'static str {
        "E exceeds 1 at grazing where alpha is below 0.2"
    }

    fn at(&self, _: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let v = sheen::sheen(x[0], x[1], tolerance)?;
        Ok(vec![v.value, v.error])
    }

    fn second_opinion(&self, _: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        Ok(vec![monte_carlo::sheen(x[0], x[1], run)?])
    }
}
