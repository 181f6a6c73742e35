//! Poles that a search has left between its samples: the search again with the formula's values
//! bound, so that nothing comes near one.

use super::constraint_check::finer;
use super::one::obedient;
use super::vanished::Obedient;
use super::{Demand, FittingError, demands};
use lobefit::approximate::target::{Sampled, Target};
use lobefit_fit::{Constraint, Options, Samples};
use lobefit_shade::{Domain, Hypothesis, prove_regular};

/// A search, and the constraints at more places that it has to keep.
pub(super) struct Searched {
    pub found: Obedient,
    pub finer: Vec<Constraint>,
}

/// What is searched.
pub(super) struct Task<'a> {
    pub hypothesis: &'a Hypothesis,
    pub samples: &'a Samples,
    pub constraints: &'a [Constraint],
    pub demands: &'a [Demand],
    pub options: &'a Options,
    pub domain: &'a Domain,
}

/// The search as it is, if it is proven finite, or if the values are bound already; else one within
/// the range that the formula should have and as much on either side of it as that is wide, if that
/// one is proven.
///
/// # Errors
/// Places that the target does not have.
pub(super) fn kept_out(
    task: &Task,
    first: Searched,
    target: &Target,
    measured: &Sampled,
) -> Result<Searched, FittingError> {
    let tape = task.hypothesis.tape();
    let bound = task.demands.iter().any(|demand| matches!(demand, Demand::Range { .. }));
    let is_regular = |found: &Obedient| prove_regular(tape, &found.exact, task.domain).is_ok();
    if bound || is_regular(&first.found) {
        return Ok(first);
    }
    let ideal = measured.ideal();
    let low = ideal.iter().copied().fold(f64::INFINITY, f64::min);
    let high = ideal.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let [low, high] = [2.0 * low - high, 2.0 * high - low].map(short);
    if !(low.is_finite() && high.is_finite()) {
        return Ok(first);
    }
    let demand = [Demand::Range { low, high }];
    let more = demands::constraints(&demand, target, task.hypothesis)?;
    let all = [task.constraints, &more].concat();
    let wider = [&first.finer[..], &finer(&more, &demand, target, task.hypothesis, measured)?].concat();
    // Within bounds that cannot be kept, or that no start reaches, nothing is found: the first
    // search stands, and its pole is reported.
    match obedient(task.hypothesis, task.samples, &all, &wider, task.options, task.domain) {
        Ok(again) if is_regular(&again) => Ok(Searched { found: again, finer: wider }),
        _ => Ok(first),
    }
}

/// In three digits, as a person would write it.
fn short(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}
