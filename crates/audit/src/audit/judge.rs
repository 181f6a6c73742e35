//! The exact judgement: the sieve's best on more texels, then on all.

use rayon::prelude::*;

use super::AuditError;
use super::axis::{AxisReading, Input};
use super::convention::Fixed;
use super::sample::{self, Candidate, Sample, View, fit_columns, judged, shared, steps};
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
    let inputs = truth.inputs();
    let along = |input: &Input| axes.iter().position(|a| a.scale.input() == *input).unwrap_or(0);
    let assigned: Vec<usize> = inputs.iter().map(along).collect();
    let nodes: Vec<Vec<f64>> = assigned
        .iter()
        .zip(inputs)
        .map(|(axis, input)| {
            let [low, high] = truth.range(lobe, *input);
            sample.nodes(*axis, &axes[*axis]).iter().map(|x| x.clamp(low, high)).collect()
        })
        .collect();
    let at: Vec<&[f64]> = nodes.iter().map(Vec::as_slice).collect();
    let values = values(truth, lobe, &at)?;
    let lengths: Vec<usize> = nodes.iter().map(Vec::len).collect();
    let view = View { values: &values, steps: steps(&lengths, &assigned), start: 0 };
    Ok(Judgement { base: view.gather(&sample.dims()), judged: judged(truth, sample, axes, lobe) })
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
    let fitted = fit_columns(values, &judgement.base, &judged, fixed, truth.columns())?;
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
