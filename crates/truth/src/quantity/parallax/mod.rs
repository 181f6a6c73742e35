//! `parallax-alpha`: the width to fetch a prefiltered chain with.

pub mod footprint;

use rayon::prelude::*;

use super::{ALPHA, Asked, Choice, Excuse, Facts, Input, Quantity, Residual, Truth, Use, Variant};
use crate::integrate::IntegrateError;

/// The width of the fetch: the first output.
const WIDTH: &str = "alpha_adjusted";

/// The use of the width.
pub const PARALLAX: Use = Use {
    name: "parallax",
    meaning: "the width of a fetch by parallax-alpha, error relative",
    metric: "relative error of the adjusted alpha",
    residual: Residual::Quotient,
    blends: false,
};

/// Whether a wider lobe than the widest would be better: the third output.
const SATURATED: &str = "saturated";

/// Saturated fetches.
static EXCUSE: Excuse = Excuse {
    output: SATURATED,
    input: "rho",
    reason: "every fetch is saturated there: the widest lobe is too narrow; begin at a smaller ratio, or at a smaller alpha",
};

/// `parallax-alpha`: the width of a fetch, seen from a probe, that covers a wall as a lobe does
/// from a shading point. It is a minimum and not an integral: there is no second opinion by Monte
/// Carlo.
#[derive(Clone, Copy, Debug)]
pub struct ParallaxAlpha;

impl Quantity for ParallaxAlpha {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "parallax-alpha",
                // rho is the distance of the shading point to the wall over the distance of the probe.
                inputs: &[
                    ALPHA,
                    Input { is_ratio: true, ..Input::new("rho", footprint::RHO).usually([1.0 / 16.0, 8.0]) },
                ],
                outputs: &[WIDTH, "tv", SATURATED, "error"],
                choices: &[Choice::Kernel],
                smallest_alpha: footprint::SMALLEST_ALPHA,
                remark: "rho: distance of the shading point over that of the probe; without kernel: half-cosine; a table: --kernel",
                ..Facts::NONE
            }
        }
    }

    fn tolerance(&self, variant: &Variant) -> f64 {
        footprint::usual_tolerance(variant.kernel())
    }

    fn uses(&self, column: &str) -> &'static [Use] {
        if column == WIDTH { &[PARALLAX, Use::VALUE] } else { &[Use::VALUE] }
    }

    fn excused(&self, column: &str) -> Option<&'static Excuse> {
        (column == WIDTH).then_some(&EXCUSE)
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let v = footprint::adjusted(variant.kernel(), x[0], x[1], tolerance)?;
        Ok(vec![v.alpha, v.tv, f64::from(u8::from(v.saturated)), v.error])
    }

    fn many(&self, asked: &Asked) -> Result<Option<Truth>, IntegrateError> {
        let (kernel, quick) = (asked.variant.kernel(), self.tolerance_of_many(asked.variant));
        if asked.tolerance < quick || asked.wants(&["tv", "error"]) {
            return Ok(None);
        }
        let [alpha, rho] = asked.columns(self)?;
        let one = |(alpha, rho): (&f64, &f64)| footprint::best(kernel, *alpha, *rho);
        let rows: Vec<(f64, bool)> = alpha.par_iter().zip(rho).map(one).collect::<Result<_, _>>()?;
        let of = |output: &str, (width, saturated): &(f64, bool)| {
            if output == SATURATED { f64::from(u8::from(*saturated)) } else { *width }
        };
        Ok(Some(Truth { error: quick, ..Truth::of(asked.outputs, &rows, of) }))
    }

    fn tolerance_of_many(&self, variant: &Variant) -> f64 {
        footprint::quick_error(variant.kernel())
    }

    fn microseconds(&self, outputs: &[&str]) -> f64 {
        if outputs.contains(&"tv") { 1e4 } else { 1e3 }
    }
}
