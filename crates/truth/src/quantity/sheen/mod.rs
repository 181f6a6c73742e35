//! `sheen-charlie` and `sheen-estevez-kulla`: E of the sheen lobe, with one visibility or the other.

mod facets;
mod integral;
pub mod lobe;
pub mod monte_carlo;
mod shadowed;

use rayon::prelude::*;

use super::{Asked, Facts, Input, MU, Quantity, Truth, Variant};
use crate::integrate::IntegrateError;
use crate::integrate::monte_carlo::{Run, Sampled};
pub use integral::{SMALLEST_ALPHA, Sheen, TOLERANCE, albedo, sheen};
pub use shadowed::EstevezKulla;

/// Largest error of the rule of sixteen nodes: 1e-11 of E, which is 399 at most.
const RULE_ERROR: f64 = 1e-8;

/// `sheen-charlie`: the directional albedo of Charlie's distribution with Neubelt's visibility,
/// which has no Smith form.
#[derive(Clone, Copy, Debug)]
pub struct SheenCharlie;

impl Quantity for SheenCharlie {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "sheen-charlie",
                inputs: &[Input::new("alpha", [SMALLEST_ALPHA, 1.0]), MU],
                outputs: &["E", "error"],
                tolerance: TOLERANCE,
                smallest_alpha: SMALLEST_ALPHA,
                changes_at_alpha: false,
                remark: "E exceeds 1 at grazing where alpha is below 0.2",
                ..Facts::NONE
            }
        }
    }

    fn at(&self, _: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let v = sheen(x[0], x[1], tolerance)?;
        Ok(vec![v.value, v.error])
    }

    fn many(&self, asked: &Asked) -> Result<Option<Truth>, IntegrateError> {
        if asked.tolerance < RULE_ERROR || asked.outputs != ["E"] {
            return Ok(None);
        }
        let [alpha, mu] = asked.columns(self)?;
        let one = |(alpha, mu): (&f64, &f64)| {
            integral::check(*alpha, *mu)?;
            Ok([albedo(*alpha, *mu)])
        };
        let rows: Vec<[f64; 1]> = alpha.par_iter().zip(mu).map(one).collect::<Result<_, IntegrateError>>()?;
        Ok(Some(Truth::of_rows(&rows, RULE_ERROR, rows.len() as u64)))
    }

    fn tolerance_of_many(&self, _: &Variant) -> f64 {
        1e-7
    }

    fn microseconds(&self, _: &[&str]) -> f64 {
        100.0
    }

    fn second_opinion(&self, _: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        Ok(vec![monte_carlo::sheen(x[0], x[1], run)?])
    }
}
