//! `ggx-glass-aniso`: energies of a rough dielectric interface with one width along the tangent and
//! another across it.

use super::aniso::{ALPHA_X, ALPHA_Y, PHI};
use super::{Choice, Facts, Fresnel, Input, MU, Quantity, Variant};
use crate::integrate::monte_carlo::{self, Run, Sampled};
use crate::integrate::{IntegrateError, aniso, glass};

/// `ggx-glass-aniso`: reflected and transmitted energy, their sum and 1 less the sum, from either side,
/// at an azimuth of the view.
#[derive(Clone, Copy, Debug)]
pub struct GgxGlassAniso;

impl Quantity for GgxGlassAniso {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: aniso::glass::QUANTITY,
                inputs: &[
                    ALPHA_X,
                    ALPHA_Y,
                    Input { domain: [glass::SMALLEST_MU, 1.0], ..MU },
                    Input { optional: false, ..PHI },
                    Input::new("ior", [1.0, glass::LARGEST_IOR]).usually([1.0, 2.0]),
                ],
                outputs: &["R", "T", "E", "loss", "error"],
                choices: &[Choice::Smith, Choice::Side],
                tolerance: aniso::glass::TOLERANCE,
                smallest_alpha: aniso::ALPHA[0],
                fresnel: Some(Fresnel::Dielectric),
                draws: monte_carlo::GLASS_DRAWS,
                ..Facts::NONE
            }
        }
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let (smith, side) = (variant.smith(self.name())?, variant.side(self.name())?);
        let v = aniso::glass::glass(smith, [x[0], x[1]], [x[2], x[3]], (x[4], side), tolerance)?;
        Ok(vec![v.r, v.t, v.e, v.loss, v.error])
    }

    fn microseconds(&self, _: &[&str]) -> f64 {
        1e4
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let (smith, side) = (variant.smith(self.name())?, variant.side(self.name())?);
        let [r, t, loss] = monte_carlo::aniso_glass(smith, [x[0], x[1]], [x[2], x[3]], (x[4], side), run)?;
        // The replicas of R and T are correlated: the sum's error is that of its complement.
        Ok(vec![r, t, Sampled { value: r.value + t.value, ..loss }, loss])
    }
}
