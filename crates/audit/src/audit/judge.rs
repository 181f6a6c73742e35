//! The exact judgement: the sieve's best on more texels, then on all, with the clamps that the ends
//! of an axis may have.

use rayon::prelude::*;

use super::AuditError;
use super::axis::{AxisReading, Input};
use super::convention::{Fixed, Misfit};
use super::sample::{self, Candidate, Fitted, Sample, View, fit_columns, judged, shared, steps};
use super::screen::best;
use super::truth::{Truth, Truths, Values};

/// Least values that tables clamp alpha and mu to; the last two are the first centre of 16 texels, which
/// a table keeps that was made larger, and the least alpha of a sheen that Khronos ships.
const FLOORS: [f64; 9] = [1e-4, 1e-3, 1e-2, 1e-5, 2e-3, 5e-3, 2e-2, 1.0 / 32.0, 7e-2];

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
    let fitted = fit_columns(&sample.values, &judgement.base, &judged, fixed, truth.columns())?;
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

/// The candidate with the clamps that fit best: of all its axes together (a corner shows only
/// that), then of each.
pub(super) fn with_floors(
    truth: &Truth,
    sample: &Sample,
    fixed: &Fixed,
    candidate: &Candidate,
) -> Result<Candidate, AuditError> {
    let mut at = candidate.clone();
    let of = |inputs: &[Input]| -> Vec<usize> {
        let open = |input: Input| inputs.contains(&input) && fixed.floor(input).is_none();
        (0..at.axes.len()).filter(|k| open(at.axes[*k].scale.input())).collect()
    };
    let (axes, iors) = (of(&[Input::Alpha, Input::Mu]), of(&[Input::Ior]));
    let least =
        |axis: &usize| sample.nodes(*axis, &candidate.axes[*axis]).into_iter().fold(f64::INFINITY, f64::min);
    let low: Vec<(usize, f64)> = axes.iter().chain(&iors).map(|axis| (*axis, least(axis))).collect();
    let groups = std::iter::once(axes.clone()).chain(axes.iter().chain(&iors).map(|axis| vec![*axis]));
    for group in groups.filter(|g| !g.is_empty()) {
        // An index of refraction is clamped as far above 1 as the others above 0.
        let least = if group.iter().any(|axis| iors.contains(axis)) { 1.0 } else { 0.0 };
        for floor in FLOORS.map(|f| least + f) {
            let raised: Vec<usize> = low
                .iter()
                .filter(|(axis, least)| group.contains(axis) && *least < floor)
                .map(|l| l.0)
                .collect();
            if raised.is_empty() {
                continue;
            }
            let mut clamped = at.clone();
            raised.iter().for_each(|axis| clamped.axes[*axis].floor = floor);
            let tried = rejudge(truth, sample, fixed, vec![clamped], Truth::ranked)?.pop();
            if let Some(tried) = tried.filter(|t| explains(t, &at)) {
                at = tried;
            }
        }
    }
    Ok(at)
}

/// Whether a clamp explains something: more of the texels as well as those before, or none fewer
/// clearly better and the worst no worse. A clamp that takes texels out of the domain explains nothing.
fn explains(clamped: &Candidate, before: &Candidate) -> bool {
    let (now, then) = (&clamped.fitted, &before.fitted);
    let max = |fitted: &Fitted| fitted.misfits.iter().flatten().map(|m| m.max).fold(0.0, f64::max);
    let worse = max(now) > 1.5 * max(then);
    // What mends a single texel and leaves much of its error mends it by chance.
    let rest = |fitted: &Fitted| {
        let of = |m: &Misfit| (m.rms * m.rms * fitted.texels as f64 - m.max * m.max).max(0.0);
        fitted.misfits.iter().flatten().map(of).fold(0.0, f64::max)
    };
    let worse = worse || rest(now) > 0.9 * rest(then) && max(now) > 0.2 * max(then);
    now.texels > then.texels && now.rank < 1.2 * then.rank
        || now.texels >= then.texels && now.rank < 0.9 * then.rank && !worse
}
