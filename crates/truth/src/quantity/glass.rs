//! `ggx-glass`: energies of a rough dielectric interface.

use super::{ALPHA, Choice, Input, Quantity, Variant};
use crate::integrate::monte_carlo::{self, Run, Sampled};
use crate::integrate::{IntegrateError, glass};

/// `ggx-glass`: reflected and transmitted energy, their sum and 1 less the sum, from either side.
#[derive(Clone, Copy, Debug)]
pub struct GgxGlass;

impl Quantity for GgxGlass {
    fn name(&self) -> &'static str {
        "ggx-glass"
    }

    fn inputs(&self) -> &'static [Input] {
        const {
            &[
                ALPHA,
                Input::new("mu", [glass::SMALLEST_MU, 1.0]),
                Input::new("ior", [1.0, glass::LARGEST_IOR]),
            ]
        }
    }

    fn outputs(&self) -> &'static [&'static str] {
        &["R", "T", "E", "loss", "error"]
    }

    fn choices(&self) -> &'static [Choice] {
        &[Choice::Smith, Choice::Side]
    }

    fn tolerance(&self, _: &Variant) -> f64 {
        glass::TOLERANCE
    }

    fn smallest_alpha(&self) -> f64 {
        glass::ALPHA[0]
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let (smith, side) = (variant.smith(self.name())?, variant.side(self.name())?);
        let v = glass::glass(smith, x[0], x[1], x[2], side, tolerance)?;
        Ok(vec![v.r, v.t, v.e, v.loss, v.error])
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let (smith, side) = (variant.smith(self.name())?, variant.side(self.name())?);
        let [r, t, loss] = monte_carlo::glass(smith, x[0], x[1], x[2], side, run)?;
        // The replicas of R and T are correlated: the sum's error is that of its complement.
        let e = Sampled { value: r.value + t.value, ..loss };
        Ok(vec![r, t, e, loss])
    }
}
