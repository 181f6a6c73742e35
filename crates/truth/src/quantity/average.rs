//! `ggx-average`: the cosine-weighted average of E, and its loss.

use lobefit_math::chebyshev::{self, Chebyshev};
use lobefit_math::ops;
use rayon::prelude::*;

use super::reflection::TRUTH_ERROR;
use super::{ALPHA, Asked, Choice, Facts, Quantity, Truth, Variant, check_unit};
use crate::integrate::monte_carlo::{self, Draw, Run, Sampled};
use crate::integrate::walk::{Walks, white};
use crate::integrate::{IntegrateError, reflection};
use crate::points::hull;

/// Nodes of the interpolant of E_avg over a [`SPAN`] of ln(alpha), in which it is analytic: within
/// 1e-9 (`crates/truth/tests/truth/many.rs`).
const NODES: usize = 48;

/// From 1e-4 to 1, with room for the rounding of an f32.
const SPAN: f64 = 9.2104;

/// Largest error of the interpolant.
const INTERPOLANT_ERROR: f64 = 1e-9;

/// Smallest alpha of the interpolant; E_avg is 1 within 1e-13 below.
const SMALLEST: f64 = 1e-7;

/// `ggx-average`: E_avg = 2 int_0^1 E(mu) mu dmu and 1 - E_avg.
#[derive(Clone, Copy, Debug)]
pub struct GgxAverage;

impl Quantity for GgxAverage {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "ggx-average",
                inputs: &[ALPHA],
                outputs: &["E_avg", "loss_avg", "error"],
                choices: &[Choice::Smith],
                tolerance: reflection::TOLERANCE,
                smallest_alpha: reflection::SMALLEST_ALPHA,
                draws: &Draw::ALL,
                ..Facts::NONE
            }
        }
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let v = reflection::average(variant.smith(self.name())?, x[0], tolerance)?;
        Ok(vec![v.e_avg, v.loss_avg, v.error])
    }

    /// E_avg from an interpolant over ln(alpha).
    fn many(&self, asked: &Asked) -> Result<Option<Truth>, IntegrateError> {
        let few = asked.points.len() <= NODES;
        if few || asked.tolerance < INTERPOLANT_ERROR || asked.outputs != ["E_avg"] {
            return Ok(None);
        }
        let (smith, [alpha]) = (asked.variant.smith(self.name())?, asked.columns(self)?);
        check_unit(self, "alpha", alpha, self.smallest_alpha())?;
        let [low, high] = hull(alpha.iter().map(|a| ops::log(a.max(SMALLEST))));
        let value = |x: &f64| {
            reflection::average(smith, ops::exp(*x).clamp(SMALLEST, 1.0), reflection::TOLERANCE)
                .map(|v| v.e_avg)
        };
        let count = NODES * ((high - low) / SPAN).ceil().max(1.0) as usize;
        let nodes = chebyshev::nodes(low, high, count);
        let values: Vec<f64> = nodes.par_iter().map(value).collect::<Result<_, _>>()?;
        let known = Chebyshev::new(low, high, values);
        let at = |alpha: &f64| known.at(ops::log(alpha.max(SMALLEST)).clamp(low, high));
        let column = alpha.par_iter().map(at).collect();
        let (columns, evaluations) = (vec![column], count as u64);
        Ok(Some(Truth { columns, error: INTERPOLANT_ERROR, evaluations }))
    }

    fn tolerance_of_many(&self, _: &Variant) -> f64 {
        TRUTH_ERROR
    }

    fn microseconds(&self, outputs: &[&str]) -> f64 {
        if outputs == ["E_avg"] { 0.1 } else { 1e4 }
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let (e, loss) = monte_carlo::average(variant.smith(self.name())?, x[0], run)?;
        Ok(vec![e, loss])
    }

    fn walked(&self, x: &[f64], walks: Walks) -> Option<Result<Sampled, IntegrateError>> {
        Some(white(x[0], [0.0, 1.0], walks))
    }
}
