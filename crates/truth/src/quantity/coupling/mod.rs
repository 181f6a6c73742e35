//! `diffuse-coupling`: what a specular lobe leaves for the diffuse base below it.

mod integral;
pub mod monte_carlo;

use super::{ALPHA, Choice, Facts, GGX_REFLECTION, Input, MU, OverF0, Quantity, Residual, Use, Variant};
use crate::integrate::monte_carlo::{Draw, Run, Sampled};
use crate::integrate::{IntegrateError, reflection};
pub use integral::{Specular, Split, TOLERANCE, coupling, factor};

/// The use of its factor.
pub const COUPLING: Use = Use {
    name: "coupling",
    meaning: "the factor of diffuse-coupling",
    metric: "error of the coupling factor",
    residual: Residual::Difference,
    blends: false,
};

/// `diffuse-coupling`: 1 less the albedo of the specular lobe.
#[derive(Clone, Copy, Debug)]
pub struct DiffuseCoupling;

impl Quantity for DiffuseCoupling {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "diffuse-coupling",
                inputs: &[ALPHA, MU, Input::new("f0", [0.0, 1.0])],
                outputs: &["factor", "error"],
                choices: &[Choice::Smith, Choice::Specular],
                tolerance: TOLERANCE,
                smallest_alpha: reflection::SMALLEST_ALPHA,
                draws: &Draw::ALL,
                ..Facts::NONE
            }
        }
    }

    fn uses(&self, _: &str) -> &'static [Use] {
        &[COUPLING, Use::VALUE]
    }

    fn over_f0(&self, variant: &Variant) -> Option<OverF0> {
        Some(OverF0 { lobe: GGX_REFLECTION, form: variant.specular?.form() })
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let (smith, specular) = (variant.smith(self.name())?, variant.specular(self.name())?);
        let v = coupling(smith, x[0], x[1], x[2], specular, tolerance)?;
        Ok(vec![v.value, v.error])
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let (smith, specular) = (variant.smith(self.name())?, variant.specular(self.name())?);
        Ok(vec![monte_carlo::coupling(smith, x[0], x[1], x[2], specular, run)?])
    }
}
