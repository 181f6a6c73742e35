//! The fetches that come nearest to a slanted footprint.

use super::least::least;
use lobefit_math::ops;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::optics::footprint::RuleTap;
use lobefit_truth::quantity::footprint::slant::{Case, Normal, Off};

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

/// Iterations of a search over fetches.
const ITERATIONS: u64 = 120;

/// Tilts of a first start spread over this many widths of the lobe.
const SPREAD: f64 = 0.6;

/// Bounds of tilts over alpha, of logarithms of widths and of weights: outside, a fetch has no part
/// in the footprint any more.
const TILTS: f64 = 12.0;
const WIDTHS: [f64; 2] = [-3.0, 1.5];
const WEIGHTS: f64 = 7.0;

/// `count` fetches along the long axis with the least H^-1 norm, from a start: those found at a
/// neighbouring slant, or a spread.
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
    let off =
        off.ok_or_else(|| IntegrateError::NotFinite { quantity: "slanted footprint", place: place() })?;
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
