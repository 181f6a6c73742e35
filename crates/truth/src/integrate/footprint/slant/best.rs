//! The fetches that come nearest to a slanted footprint.

use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentOpt;

use super::QUANTITY;
use super::case::{Case, Off};
use super::marquardt::{Normal, least};
use crate::integrate::IntegrateError;
use crate::optics::footprint::RuleTap;
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

/// Fetches that come nearest, and what they are off by.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// From the one nearest to the shading point to the farthest.
    pub taps: Vec<RuleTap>,
    /// What is left.
    pub off: Off,
    /// Whether the search came to rest.
    pub settled: bool,
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

/// Iterations of a search over fetches.
const ITERATIONS: u64 = 120;

/// Tilts of a first start spread over this many widths of the lobe.
const SPREAD: f64 = 0.6;

/// Bounds of tilts over alpha, of logarithms of widths and of weights: outside, a fetch has no part in the footprint any more.
const TILTS: f64 = 12.0;
const WIDTHS: [f64; 2] = [-3.0, 1.5];
const WEIGHTS: f64 = 7.0;

/// `count` fetches along the long axis with the least H^-1 norm, from a start: those found at a neighbouring slant, or a spread.
///
/// # Errors
/// A start whose rays miss the wall; a solver that fails. A start of another count is none.
pub fn best_taps(case: &Case, count: usize, start: Option<&Found>) -> Result<Found, IntegrateError> {
    let start = start.filter(|found| found.taps.len() == count);
    let first = start.map_or_else(|| spread(case, count), |found| shrunk(case, found));
    let squares = |p: &[f64]| -> Option<Normal> {
        let taps = unpacked(p);
        let inside = |[tilt, width, weight]: &[f64; 3]| {
            tilt.abs() < TILTS && (WIDTHS[0]..WIDTHS[1]).contains(width) && weight.abs() < WEIGHTS
        };
        if taps.iter().all(inside) { case.squares(&taps) } else { None }
    };
    let outcome = least(squares, &first, ITERATIONS)?;
    let mut found = unpacked(&outcome.at);
    found.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let whole: f64 = found.iter().map(|tap| ops::exp(tap[2])).sum();
    let taps: Vec<RuleTap> = found.iter().map(|tap| case.rule_tap(*tap, whole)).collect();
    let off = case.fetched(&taps).map(|footprint| case.off(&footprint));
    let place = || format!("{count} fetches at alpha = {}, {:?}", case.alpha, case.slant);
    let off = off.ok_or_else(|| IntegrateError::NotFinite { quantity: QUANTITY, place: place() })?;
    Ok(Found { taps, off, settled: outcome.settled })
}

/// Parameters in the order tilts, widths, weights, by fetches.
fn unpacked(p: &[f64]) -> Vec<[f64; 3]> {
    let n = p.len() / 3;
    (0..n).map(|i| [p[i], p[n + i], p[2 * n + i]]).collect()
}

fn spread(case: &Case, count: usize) -> Vec<f64> {
    let last = (count as f64 - 1.0).max(1.0);
    let mut start: Vec<f64> =
        (0..count).map(|i| if count == 1 { 0.0 } else { SPREAD * (2.0 * i as f64 / last - 1.0) }).collect();
    // narrower the more there are
    start.extend(std::iter::repeat_n(-0.1 * ops::log(count as f64), count));
    start.extend(std::iter::repeat_n(0.0, count));
    within(case, start)
}

fn shrunk(case: &Case, found: &Found) -> Vec<f64> {
    let of = |part: &dyn Fn(&RuleTap) -> f64| found.taps.iter().map(part).collect::<Vec<f64>>();
    let mut start = of(&|tap| tap.tilt / case.alpha);
    start.extend(of(&|tap| ops::log(tap.width)));
    start.extend(of(&|tap| ops::log(tap.weight).max(-0.9 * WEIGHTS)));
    within(case, start)
}

/// Tilts short of the wall's horizon: t/(1 + t slope) where t `slope` is large.
fn within(case: &Case, mut start: Vec<f64>) -> Vec<f64> {
    let count = start.len() / 3;
    let slope = case.stretch.slope * case.alpha;
    let steep = start[..count].iter().map(|tilt| tilt * slope).fold(0.0, f64::max);
    if steep > FARTHEST {
        start[..count]
            .iter_mut()
            .filter(|tilt| **tilt * slope > 0.0)
            .for_each(|tilt| *tilt *= FARTHEST / steep);
    }
    start
}

/// Share of the way to the horizon that a start's farthest ray goes.
const FARTHEST: f64 = 0.8;
