//! The best width.

use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentOpt;

use super::measures::variation;
use super::{QUANTITY, check, radii};
use crate::integrate::IntegrateError;
use crate::optics::kernel::Kernel;
use lobefit_math::ops;

/// Steps of ln R: exp(-pi^2/h) is 2e-11 and 1e-14.
const STEPS: [f64; 2] = [0.4, 0.3];

/// Where the kernel is a table, piecewise smooth alone, the first step, of one that ends with a
/// jump and of any other, and what each is of the one before: at most so many.
const TABLE_STEP: f64 = 0.1;
const CUT_STEP: f64 = 0.02;
const REFINED: f64 = 0.7;
const REFINEMENTS: usize = 16;

/// How many times the largest difference between the last three such widths their error is at most.
const SAFETY: f64 = 10.0;

/// ln alpha' is sought this far on either side of a closed form, and farther where the distance
/// still falls; and this far above 0, where a width is saturated.
const REACH: f64 = 0.3;

/// Widenings of the interval: the closed form is nowhere off by a factor of 10 where lobes are as
/// wide as they say.
const WIDENINGS: usize = 8;

/// Widths above 1 that count as 1, in the logarithm: what rounding leaves at alpha = rho = 1.
const SATURATED: f64 = 1e-6;

/// Relative and absolute tolerance of ln alpha'; a minimum of a smooth function is not known
/// better.
const SOUGHT: f64 = 1e-10;

/// How far from its minimum the distance differs by no more than its rounding.
const FLAT: f64 = 1e-8;

/// Iterations of Brent's method; a dozen are usual.
const ITERATIONS: u64 = 100;

/// `parallax-alpha` at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adjusted {
    /// The best width, at most 1.
    pub alpha: f64,
    /// Total variation between target and fetch, (1/2) int |W_t - W_c| over the wall, in [0, 1].
    pub tv: f64,
    /// Whether a wider lobe than any would be better.
    pub saturated: bool,
    /// Bound on the error of `alpha` and `tv`.
    pub error: f64,
}

/// `parallax-alpha` at alpha in {0} or [1e-6, 1] and rho in [1e-6, 1e3], to an absolute
/// `tolerance`.
///
/// # Errors
/// An input outside its domain; a tolerance that is not reached.
pub fn adjusted(kernel: &Kernel, alpha: f64, rho: f64, tolerance: f64) -> Result<Adjusted, IntegrateError> {
    check(alpha, rho)?;
    if alpha == 0.0 {
        return Ok(Adjusted { alpha: 0.0, tv: 0.0, saturated: false, error: 0.0 });
    }
    let (exact, saturated, error) = if kernel.is_analytic() {
        let rough = search(kernel, alpha, rho, STEPS[0])?.0;
        let (exact, saturated) = search(kernel, alpha, rho, STEPS[1])?;
        // tv changes by at most the relative change of alpha'
        (exact, saturated, 2.0 * (rough / exact - 1.0).abs() + FLAT)
    } else {
        of_table(kernel, alpha, rho, tolerance)?
    };
    if error > tolerance {
        let place = place(alpha, rho);
        return Err(IntegrateError::Tolerance { quantity: QUANTITY, place, reached: error, tolerance });
    }
    let tv = variation(kernel, &kernel.lobe(alpha), rho, &kernel.lobe(exact), exact.min(alpha * rho));
    Ok(Adjusted { alpha: exact, tv, saturated, error })
}

/// The best width, whether it is saturated, and its error, by finer and finer steps until that is
/// within a tolerance or there are enough of them.
fn of_table(
    kernel: &Kernel,
    alpha: f64,
    rho: f64,
    tolerance: f64,
) -> Result<(f64, bool, f64), IntegrateError> {
    let mut step = quick_step(kernel);
    let mut widths: Vec<f64> = Vec::new();
    loop {
        let (width, saturated) = search(kernel, alpha, rho, step)?;
        widths.push(width);
        step *= REFINED;
        let [.., a, b, c] = widths[..] else { continue };
        let apart = (a / c - 1.0).abs().max((b / c - 1.0).abs()).max((a / b - 1.0).abs());
        let error = SAFETY * apart + FLAT;
        if error <= tolerance || widths.len() == REFINEMENTS {
            return Ok((c, saturated, error));
        }
    }
}

fn place(alpha: f64, rho: f64) -> String {
    format!("alpha = {alpha:?}, rho = {rho:?}")
}

/// The step of the quick rule.
fn quick_step(kernel: &Kernel) -> f64 {
    match (kernel.is_analytic(), kernel.is_cut()) {
        (true, _) => STEPS[0],
        (false, false) => TABLE_STEP,
        (false, true) => CUT_STEP,
    }
}

/// The best width and whether it is saturated, by the coarser rule alone: for many points.
///
/// # Errors
/// As [`adjusted`].
pub fn best(kernel: &Kernel, alpha: f64, rho: f64) -> Result<(f64, bool), IntegrateError> {
    check(alpha, rho)?;
    if alpha == 0.0 { Ok((0.0, false)) } else { search(kernel, alpha, rho, quick_step(kernel)) }
}

/// The squared distance of two encircled energies over the wall, by ln alpha'.
#[derive(Clone)]
struct Distance<'a> {
    kernel: &'a Kernel,
    /// Wall radii, each with the energy that the target holds within.
    target: Vec<(f64, f64)>,
}

impl Distance<'_> {
    fn at(&self, ln_alpha: f64) -> f64 {
        let lobe = self.kernel.lobe(ops::exp(ln_alpha));
        self.target.iter().map(|(radius, energy)| lobe.encircled(*radius) - energy).map(|d| d * d).sum()
    }
}

impl CostFunction for Distance<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, ln_alpha: &f64) -> Result<f64, argmin::core::Error> {
        Ok(self.at(*ln_alpha))
    }
}

fn search(kernel: &Kernel, alpha: f64, rho: f64, step: f64) -> Result<(f64, bool), IntegrateError> {
    let not_finite = || IntegrateError::NotFinite { quantity: QUANTITY, place: place(alpha, rho) };
    let guess = rho * alpha / (1.0 + alpha - rho * alpha).max(rho * alpha);
    let lobe = kernel.lobe(alpha);
    let target = radii(kernel, guess.min(alpha * rho), rho.max(1.0), step)
        .map(|r| (r, lobe.encircled(r / rho)))
        .collect();
    let distance = Distance { kernel, target };
    let middle = ops::log(guess);
    let [low, high] = bracket(&distance, middle).ok_or_else(|| IntegrateError::NoMinimum {
        quantity: QUANTITY,
        place: place(alpha, rho),
        what: "a width of the fetch",
    })?;
    let solver = BrentOpt::new(low, high).set_tolerance(SOUGHT, SOUGHT);
    let outcome = Executor::new(distance, solver)
        .configure(|state| state.max_iters(ITERATIONS))
        .ctrlc(false)
        .timer(false)
        .run()
        .map_err(|_| not_finite())?;
    let found = outcome.state.get_best_param().copied().filter(|x| x.is_finite()).ok_or_else(not_finite)?;
    Ok(if found > SATURATED { (1.0, true) } else { (ops::exp(found).min(1.0), false) })
}

/// An interval of ln alpha' about `middle` with a minimum inside, or at its upper end where that is
/// saturated; `None` where the distance falls on and on, as with a table whose lobes do not follow
/// their widths.
fn bracket(distance: &Distance, middle: f64) -> Option<[f64; 2]> {
    let lows = std::iter::successors(Some(middle - REACH), |low| Some(low - REACH));
    let highs =
        std::iter::successors(Some((middle + REACH).min(REACH)), |high| Some((high + REACH).min(REACH)));
    let low = lows.take(WIDENINGS + 1).find(|low| distance.at(*low) >= distance.at(low + 0.5 * REACH))?;
    let high = highs
        .take(WIDENINGS + 1)
        .find(|high| *high >= REACH || distance.at(*high) >= distance.at(high - 0.5 * REACH))?;
    Some([low, high])
}
