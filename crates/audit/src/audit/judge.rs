//! The exact judgement: the sieve's best on more texels, then on all, with the clamps that the ends
//! of an axis may have.

use rayon::prelude::*;

use super::AuditError;
use super::axis::{AxisReading, Input};
use super::column::Column;
use super::convention::{Fixed, Misfit};
use super::errors::spread;
use super::sample::{self, Candidate, Fitted, Sample, View, fit_columns, judged, shared, steps};
use super::screen::best;
use super::truth::{Truth, Truths, Values};

/// Least values that tables clamp alpha and mu to; the last two are the first centre of 16 texels, which
/// a table keeps that was made larger, and the least alpha of a sheen that Khronos ships.
const FLOORS: [f64; 9] = [1e-4, 1e-3, 1e-2, 1e-5, 2e-3, 5e-3, 2e-2, 1.0 / 32.0, 7e-2];

/// Lines are the same that differ by no more than this share of what the table spans.
const SAME: f64 = 1e-6;

/// What a clamp makes one differs by no more than this share of what the truth does: of samples by noise.
const ALIKE: f64 = 0.2;

/// One line is clamped that lies below this share of the floor.
const FAR_BELOW: f64 = 0.7;

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
    let lines = Clampable::of(truth, sample, candidate)?;
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
        let seen = if let [axis] = group[..] { lines.held(axis, &candidate.axes[axis]) } else { Vec::new() };
        let raised = |at: &Candidate, floor: f64| -> Result<Option<Candidate>, AuditError> {
            let below = low.iter().filter(|(axis, least)| group.contains(axis) && *least < floor);
            let axes: Vec<usize> = below.map(|(axis, _)| *axis).collect();
            let differ = |axis: &usize| lines.differ(*axis, &candidate.axes[*axis], [least, floor]);
            if axes.is_empty() || axes.iter().any(differ) {
                return Ok(None);
            }
            let mut clamped = at.clone();
            axes.iter().for_each(|axis| clamped.axes[*axis].floor = floor);
            Ok(rejudge(truth, sample, fixed, vec![clamped], Truth::ranked)?.pop())
        };
        for floor in FLOORS.map(|f| least + f) {
            at = raised(&at, floor)?.filter(|t| explains(t, &at)).unwrap_or(at);
        }
        // Of those between two lines that explain something the nearest is taken, and looked about.
        let (mut width, mut nearest) = (seen.get(1).map_or(0.0, |next| next - seen[0]), None);
        for floor in seen {
            let is_nearer = |t: &Candidate| nearest.is_some() && t.fitted.rank < at.fitted.rank;
            if let Some(tried) = raised(&at, floor)?.filter(|t| explains(t, &at) || is_nearer(t)) {
                (at, nearest) = (tried, Some(floor));
            }
        }
        while let Some(floor) = nearest.filter(|floor| width > NARROW * floor) {
            width *= 0.5;
            for floor in [floor - width, floor + width] {
                if let Some(tried) = raised(&at, floor)?.filter(|t| t.fitted.rank < at.fitted.rank) {
                    (at, nearest) = (tried, Some(floor));
                }
            }
        }
    }
    Ok(at)
}

/// Lines of a sample along an axis, which a clamp makes one, and of its truth without a clamp.
struct Clampable<'a> {
    sample: &'a Sample,
    truth: Vec<Vec<f64>>,
}

impl<'a> Clampable<'a> {
    fn of(truth: &Truth, sample: &'a Sample, candidate: &Candidate) -> Result<Clampable<'a>, AuditError> {
        let judgement = judge(truth, sample, &candidate.axes, candidate.lobe, Truth::ranked)?;
        let value = |column: Column| judgement.base.iter().map(|base| column.value(*base)).collect();
        let of = |(column, own): (&Option<Column>, &Vec<f64>)| column.map_or_else(|| own.clone(), value);
        let columns = candidate.fitted.columns.iter().zip(&sample.values);
        Ok(Clampable { sample, truth: columns.map(of).collect() })
    }

    /// Places along an axis at which an input is below a floor, the least first.
    fn below(&self, axis: usize, reading: &AxisReading, floor: f64) -> Vec<usize> {
        let nodes = self.sample.nodes(axis, reading);
        let mut places: Vec<usize> = (0..nodes.len()).filter(|k| nodes[*k] < floor).collect();
        places.sort_by(|a, b| nodes[*a].total_cmp(&nodes[*b]));
        places
    }

    /// Root mean square of the differences of lines of the table or of its truth from the first of them,
    /// beside what the values span; the largest of the channels. What stands at the largest value may be
    /// clamped itself.
    fn difference(&self, of: &[Vec<f64>], axis: usize, lines: &[usize]) -> f64 {
        let dims = self.sample.dims();
        let step: usize = dims[..axis].iter().product();
        let along = |i: usize| i / step % dims[axis];
        let channel = |(values, own): (&Vec<f64>, &Vec<f64>)| {
            let high = own.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let first = |i: usize| i + lines[0] * step - along(i) * step;
            let counts = |i: &usize| lines.contains(&along(*i)) && own[*i] != high && own[first(*i)] != high;
            let squares = (0..own.len()).filter(counts).map(|i| values[i] - values[first(i)]).map(|d| d * d);
            let squares: Vec<f64> = squares.collect();
            (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt() / spread(own.iter().copied())
        };
        of.iter().zip(&self.sample.values).map(channel).fold(0.0, f64::max)
    }

    /// Whether what a floor makes one differs nearly as much as without it. Of one line alone that cannot
    /// be seen: it has to lie far below the floor, both taken from the `least` that an input can be.
    fn differ(&self, axis: usize, reading: &AxisReading, [least, floor]: [f64; 2]) -> bool {
        let lines = self.below(axis, reading, floor);
        match lines[..] {
            [] => false,
            [one] => self.sample.nodes(axis, reading)[one] - least > FAR_BELOW * (floor - least),
            _ => {
                let own = self.difference(&self.sample.values, axis, &lines);
                own > SAME.max(ALIKE * self.difference(&self.truth, axis, &lines))
            }
        }
    }

    /// What an input was clamped to by the look of it: where the first lines are the same, the last of
    /// them, or between that and the next.
    fn held(&self, axis: usize, reading: &AxisReading) -> Vec<f64> {
        let nodes = self.sample.nodes(axis, reading);
        let lines = self.below(axis, reading, f64::INFINITY);
        let is_same = |n: &usize| self.difference(&self.sample.values, axis, &lines[..*n]) < SAME;
        let Some(same) = (2..lines.len()).take_while(is_same).last() else { return Vec::new() };
        let [last, next] = [nodes[lines[same - 1]], nodes[lines[same]]];
        (0..8).map(|k| last + (next - last) * f64::from(k) / 8.0).collect()
    }
}

/// Share of a clamp to which it is looked for between two lines.
const NARROW: f64 = 1e-3;

/// Share of the largest error that is left where it was one of a clamp.
const MENDED: f64 = 0.05;

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
    // A corner where the truth jumps, of a table that is rounded everywhere.
    let is_mended = max(now) < MENDED * max(then);
    now.texels >= then.texels && now.rank <= then.rank && is_mended
        || now.texels > then.texels && now.rank < 1.2 * then.rank
        || now.texels >= then.texels && now.rank < 0.9 * then.rank && !worse
}
