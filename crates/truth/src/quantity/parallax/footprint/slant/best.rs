//! The width of one fetch that comes nearest to a slanted footprint.

use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentOpt;

use super::QUANTITY;
use super::case::{Case, Off};
use crate::integrate::IntegrateError;
use lobefit_math::ops;

/// What a width is best for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nearest {
    /// The total variation.
    Variation,
    /// The root mean square of the energies per area.
    Square,
    /// The H^-1 norm.
    Distance,
}

impl Nearest {
    fn of(self, off: &Off) -> f64 {
        match self {
            Nearest::Variation => off.tv,
            Nearest::Square => off.l2,
            Nearest::Distance => off.distance,
        }
    }
}

/// ln alpha' is sought this far on either side of that of the same area.
const REACH: f64 = 1.6;

/// Tolerance of ln alpha'.
const SOUGHT: f64 = 1e-6;

/// Iterations of Brent's method; a dozen or two are usual.
const WIDTH_ITERATIONS: u64 = 60;

struct Straight<'a> {
    case: &'a Case,
    nearest: Nearest,
}

impl Straight<'_> {
    fn off(&self, alpha: f64) -> Option<Off> {
        Some(self.case.off(&self.case.normalised(self.case.straight(alpha))?))
    }
}

impl CostFunction for Straight<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, ln_alpha: &f64) -> Result<f64, argmin::core::Error> {
        let off = self.off(ops::exp(*ln_alpha));
        Ok(self.nearest.of(&off.ok_or_else(|| argmin::core::Error::msg("no fetch"))?))
    }
}

/// The best width, at most 1, of one fetch about the probe's ray, and what it is off by.
///
/// # Errors
/// A solver that fails.
pub fn best_width(case: &Case, nearest: Nearest) -> Result<(f64, Off), IntegrateError> {
    let failed = || IntegrateError::NotFinite {
        quantity: QUANTITY,
        place: format!("best width at alpha = {}, {:?}", case.alpha, case.slant),
    };
    let middle = ops::log((case.alpha * case.stretch.area).min(1.0));
    let straight = Straight { case, nearest };
    let solver = BrentOpt::new(middle - REACH, (middle + REACH).min(0.0)).set_tolerance(SOUGHT, SOUGHT);
    let outcome = Executor::new(Straight { case, nearest }, solver)
        .configure(|state| state.max_iters(WIDTH_ITERATIONS))
        .ctrlc(false)
        .timer(false)
        .run()
        .map_err(|_| failed())?;
    let found = outcome.state.get_best_param().copied().filter(|x| x.is_finite()).ok_or_else(failed)?;
    let alpha = ops::exp(found);
    Ok((alpha, straight.off(alpha).ok_or_else(failed)?))
}
