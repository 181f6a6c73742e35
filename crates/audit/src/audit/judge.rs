//! The exact judgement: the sieve's best on more texels, then on all.

use rayon::prelude::*;

use super::AuditError;
use super::axis::AxisReading;
use super::convention::Fixed;
use super::sample::{self, Candidate, Sample, Tensor, assigned, fit_columns, judged, nodes, shared};
use super::screen::best;
use super::truth::{Truth, Truths, Values};

/// Base values at every texel of a sample under a reading, in the table's order, and which are
/// judged.
pub(super) struct Judgement {
    /// Base values; the ends of the range stand in where a texel is not judged.
    pub base: Values,
    /// Whether a texel lies where the truth can be had.
    pub judged: Vec<bool>,
}

/// The truth under a reading: exact, quick, or that by which conventions are ranked, as `values` has it.
pub(super) fn judge<'a>(
    truth: &Truth<'a>,
    sample: &Sample,
    axes: &[AxisReading],
    lobe: usize,
    values: Truths<'a>,
) -> Result<Judgement, AuditError> {
    let assigned = assigned(truth, axes);
    let nodes = nodes(truth, lobe, &assigned, |axis| sample.nodes(axis, &axes[axis]));
    let tensor = Tensor::new(truth, lobe, &nodes, &assigned, values)?;
    Ok(Judgement { base: tensor.gathered(0, &sample.dims()), judged: judged(truth, sample, axes, lobe) })
}

/// A candidate with its figures by a judgement.
fn refit(
    truth: &Truth,
    sample: &Sample,
    fixed: &Fixed,
    candidate: Candidate,
    judgement: Judgement,
) -> Option<Candidate> {
    let shared = shared(truth, sample, fixed, candidate.lobe);
    let judged = sample::ranked(judgement.judged, shared.as_ref());
    let values = (sample.values.as_slice(), sample.at_one.as_slice());
    let fitted = fit_columns(values, &judgement.base, &judged, fixed, truth.spec.columns)?;
    Some(Candidate { fitted, ..candidate })
}

/// Candidates judged again on another sample by `values`, the best first. Truths are had one reading
/// after the other, since readings share an edge.
pub(super) fn rejudge<'a>(
    truth: &Truth<'a>,
    sample: &Sample,
    fixed: &Fixed,
    list: Vec<Candidate>,
    values: Truths<'a>,
) -> Result<Vec<Candidate>, AuditError> {
    let of = |c: &Candidate| judge(truth, sample, &c.axes, c.lobe, values);
    let judgements: Vec<Judgement> = list.iter().map(of).collect::<Result<_, _>>()?;
    let both = list.into_par_iter().zip(judgements);
    let done = both.filter_map(|(candidate, judgement)| refit(truth, sample, fixed, candidate, judgement));
    Ok(best(done.collect(), usize::MAX))
}
