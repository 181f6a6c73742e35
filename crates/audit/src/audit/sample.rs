//! A part of a table, and conventions tried on it.

use std::cell::OnceCell;

use super::axis::{AxisReading, Input};
use super::column::Column;
use super::convention::{Convention, Fixed, Misfit};
use super::preferred::BEYOND_DOUBT;
use super::table::{AuditedTable, place};
use super::truth::{Beyond, Truth, Truths, Values};
use super::{AuditError, CLEAR, work};

/// Texels of some places along every axis.
#[derive(Clone)]
pub(super) struct Sample {
    /// Size of the whole table.
    pub size: Vec<usize>,
    /// Texels of it that are not dead.
    pub texels: usize,
    /// The places along every axis, rising.
    pub at: Vec<Vec<usize>>,
    /// Values of every live channel, the first axis fastest.
    pub values: Vec<Vec<f64>>,
    /// Of every live channel whether it is of a function at an f0 of 1.
    pub at_one: Vec<bool>,
    /// Of every texel whether it is not to be judged; nothing where all are.
    pub left_out: Vec<bool>,
}

impl Sample {
    /// At most `most` places along every axis, evenly spread; with `inner` none of them at an end, and
    /// without it none at an end that is dead.
    pub(super) fn new(audited: &AuditedTable, live: &[usize], most: usize, inner: bool) -> Sample {
        let mut at: Vec<Vec<usize>> = audited.size.iter().map(|n| spread(*n, most, inner)).collect();
        at.iter_mut().zip(&audited.dead).for_each(|(at, dead)| at.retain(|k| !dead.contains(k)));
        Sample::at(audited, live, at)
    }

    /// Some of the rows of a table of two axes, and all of its columns, but for those that are dead.
    pub(super) fn rows(audited: &AuditedTable, live: &[usize], rows: std::ops::Range<usize>) -> Sample {
        let mut at: Vec<Vec<usize>> = vec![(0..audited.size[0]).collect(), rows.collect()];
        at.iter_mut().zip(&audited.dead).for_each(|(at, dead)| at.retain(|k| !dead.contains(k)));
        Sample::at(audited, live, at)
    }

    /// One texel.
    pub(super) fn one(audited: &AuditedTable, live: &[usize], texel: &[usize]) -> Sample {
        Sample::at(audited, live, texel.iter().map(|k| vec![*k]).collect())
    }

    /// The texels at these places along every axis.
    fn at(audited: &AuditedTable, live: &[usize], at: Vec<Vec<usize>>) -> Sample {
        let (size, steps) = (audited.size.clone(), strides(&audited.size));
        let values = live.iter().map(|c| taken(&audited.channels[*c].values, 0, &steps, &at)).collect();
        let at_one = live.iter().map(|k| audited.is_at_one(&audited.channels[*k])).collect();
        Sample { size, texels: alive(audited), at, values, at_one, left_out: Vec::new() }
    }

    /// Index along every axis of the table.
    pub(super) fn texel(&self, i: usize) -> Vec<usize> {
        place(i, &self.dims()).iter().zip(&self.at).map(|(k, at)| at[*k]).collect()
    }

    /// Places along every axis.
    pub(super) fn dims(&self) -> Vec<usize> {
        self.at.iter().map(Vec::len).collect()
    }

    /// At most `most` of the places along every axis, and where the sample holds their texels.
    pub(super) fn thinned(&self, most: usize) -> (Vec<Vec<usize>>, Vec<usize>) {
        let dims = self.dims();
        let kept: Vec<Vec<usize>> = dims.iter().map(|n| spread(*n, most, false)).collect();
        let places = kept.iter().zip(&self.at).map(|(kept, at)| kept.iter().map(|k| at[*k]).collect());
        (places.collect(), offsets(&kept, &strides(&dims)))
    }

    /// Some of its places along every axis.
    pub(super) fn only(&self, kept: &[Vec<usize>]) -> Sample {
        let offsets = offsets(kept, &strides(&self.dims()));
        let places = kept.iter().zip(&self.at).map(|(kept, at)| kept.iter().map(|k| at[*k]).collect());
        let values = self.values.iter().map(|list| offsets.iter().map(|i| list[*i]).collect());
        let left_out = if self.left_out.is_empty() { &[][..] } else { &offsets[..] };
        Sample {
            at: places.collect(),
            values: values.collect(),
            left_out: left_out.iter().map(|i| self.left_out[*i]).collect(),
            ..self.clone()
        }
    }

    /// Which lines along every axis are the same in all of some channels as the one before, but for this
    /// share of their values.
    pub(super) fn repeated(&self, channels: &[impl AsRef<[f64]>], share: f64) -> Vec<Vec<bool>> {
        let dims = self.dims();
        let mut repeated: Vec<Vec<bool>> = dims.iter().map(|n| (0..*n).map(|k| k > 0).collect()).collect();
        for own in channels.iter().map(AsRef::as_ref) {
            for (i, value) in own.iter().enumerate() {
                let mut step = 1;
                for (lines, n) in repeated.iter_mut().zip(&dims) {
                    let k = i / step % n;
                    lines[k] &= k > 0 && (own[i - step] - value).abs() <= share * value.abs();
                    step *= n;
                }
            }
        }
        repeated
    }

    /// Whether a texel lies on one of the lines that are marked along every axis.
    pub(super) fn lies_on(&self, i: usize, marked: &[Vec<bool>]) -> bool {
        let mut rest = i;
        marked.iter().any(|lines| {
            let k = rest % lines.len();
            rest /= lines.len();
            lines[k]
        })
    }

    /// The inputs at the places of one axis.
    pub(super) fn nodes(&self, axis: usize, reading: &AxisReading) -> Vec<f64> {
        self.at[axis].iter().map(|i| reading.node(*i, self.size[axis])).collect()
    }
}

/// Texels that are not dead.
fn alive(audited: &AuditedTable) -> usize {
    let dead = |axis: usize| audited.dead.get(axis).map_or(0, Vec::len);
    audited.size.iter().enumerate().map(|(axis, n)| n - dead(axis)).product()
}

/// At most `most` of 0..n, both ends among them or neither.
pub(super) fn spread(n: usize, most: usize, inner: bool) -> Vec<usize> {
    if inner {
        let count = most.min(n - 2);
        return (0..count).map(|k| 1 + k * (n - 2) / count).collect();
    }
    if n <= most {
        return (0..n).collect();
    }
    (0..most).map(|k| k * (n - 1) / (most - 1)).collect()
}

/// Truths at every combination of the nodes along some axes, the truth's first input fastest.
pub(super) struct Tensor {
    pub values: Values,
    /// Step along every axis of the table.
    pub steps: Vec<usize>,
}

impl Tensor {
    /// By `values`, at the nodes of every input, each of which runs along an axis as `assigned` has it.
    pub(super) fn new<'a>(
        truth: &Truth<'a>,
        lobe: usize,
        nodes: &[impl AsRef<[f64]>],
        assigned: &[usize],
        values: Truths<'a>,
    ) -> Result<Tensor, AuditError> {
        let at: Vec<&[f64]> = nodes.iter().map(AsRef::as_ref).collect();
        let lengths: Vec<usize> = at.iter().map(|nodes| nodes.len()).collect();
        Ok(Tensor { values: values(truth, lobe, &at)?, steps: steps(&lengths, assigned) })
    }

    /// The values at so many places along every axis of a table from an element on, in the table's order.
    pub(super) fn gathered(&self, start: usize, dims: &[usize]) -> Values {
        taken(&self.values, start, &self.steps, &every(dims))
    }
}

/// Axis along which each input of a truth runs.
pub(super) fn assigned(truth: &Truth, axes: &[AxisReading]) -> Vec<usize> {
    let along = |input: &Input| axes.iter().position(|a| a.scale.input() == *input).unwrap_or(0);
    truth.spec.inputs.iter().map(along).collect()
}

/// The nodes of every input, `own` of the axis that it runs along, moved into the range of a lobe.
pub(super) fn nodes(
    truth: &Truth,
    lobe: usize,
    assigned: &[usize],
    own: impl Fn(usize) -> Vec<f64>,
) -> Vec<Vec<f64>> {
    let of = |(axis, input): (&usize, &Input)| {
        let [low, high] = truth.range(lobe, *input);
        own(*axis).into_iter().map(|x| x.clamp(low, high)).collect()
    };
    assigned.iter().zip(truth.spec.inputs).map(of).collect()
}

/// Steps along every axis of a tensor whose dimension k runs along axis `assigned[k]`.
fn steps(dims: &[usize], assigned: &[usize]) -> Vec<usize> {
    let mut steps = vec![0; assigned.len()];
    let mut step = 1;
    for (k, axis) in assigned.iter().enumerate() {
        steps[*axis] = step;
        step *= dims[k];
    }
    steps
}

/// Steps along every axis of a table, the first of which is fastest.
fn strides(size: &[usize]) -> Vec<usize> {
    steps(size, &(0..size.len()).collect::<Vec<_>>())
}

/// Every place along every axis.
pub(super) fn every(dims: &[usize]) -> Vec<Vec<usize>> {
    dims.iter().map(|n| (0..*n).collect()).collect()
}

/// Where every combination of places lies, the first axis fastest.
pub(super) fn offsets(places: &[Vec<usize>], steps: &[usize]) -> Vec<usize> {
    places.iter().zip(steps).fold(vec![0], |faster, (places, step)| {
        places.iter().flat_map(|k| faster.iter().map(move |offset| offset + k * step)).collect()
    })
}

/// The elements there, from one on. A list of all offsets would be as long as the result.
fn taken<T: Copy>(list: &[T], start: usize, steps: &[usize], places: &[Vec<usize>]) -> Vec<T> {
    let mut out = Vec::with_capacity(places.iter().map(Vec::len).product());
    for line in offsets(&places[1..], &steps[1..]) {
        out.extend(places[0].iter().map(|k| list[start + line + k * steps[0]]));
    }
    out
}

/// Which texels of a sample lie where the truth can be had.
pub(super) fn judged(truth: &Truth, sample: &Sample, axes: &[AxisReading], lobe: usize) -> Vec<bool> {
    let of = |(axis, reading): (usize, &AxisReading)| judged_along(truth, sample, (axis, reading), lobe);
    let along: Vec<Vec<bool>> = axes.iter().enumerate().map(of).collect();
    let mut judged = everywhere(along.iter().map(Vec::as_slice));
    judged.iter_mut().zip(&sample.left_out).for_each(|(judged, out)| *judged &= !out);
    judged
}

/// Which places of a sample along one axis lie where the truth can be had.
pub(super) fn judged_along(
    truth: &Truth,
    sample: &Sample,
    (axis, reading): (usize, &AxisReading),
    lobe: usize,
) -> Vec<bool> {
    let input = reading.scale.input();
    sample.nodes(axis, reading).iter().map(|x| truth.judges(lobe, input, *x)).collect()
}

/// Why places of a sample are not judged, each cause once.
pub(super) fn beyond(truth: &Truth, sample: &Sample, axes: &[AxisReading], lobe: usize) -> Vec<Beyond> {
    let mut found: Vec<Beyond> = Vec::new();
    for (axis, reading) in axes.iter().enumerate() {
        for x in sample.nodes(axis, reading) {
            let cause = truth.beyond(lobe, reading.scale.input(), x);
            found.extend(cause.filter(|cause| !found.contains(cause)));
        }
    }
    found
}

/// At every texel whether all of its places along the axes are marked, the first axis fastest.
pub(crate) fn everywhere<'a>(along: impl Iterator<Item = &'a [bool]>) -> Vec<bool> {
    along.fold(vec![true], |faster, own| {
        own.iter().flat_map(|own| faster.iter().map(move |faster| *faster && *own)).collect()
    })
}

/// A reading of an argument of a function under which fewer than one place in this many is judged
/// is no reading of it.
const LEAST_OF_ARGUMENT: usize = 8;

/// Which texels of a sample of a function are judged under every reading of its arguments, so that
/// all are ranked on the same points; nothing where too few are, as in a narrow domain, which lies
/// elsewhere under every reading, and nothing of a table, whose readings tell by what they leave out.
pub(super) fn shared(truth: &Truth, sample: &Sample, fixed: &Fixed, lobe: usize) -> Option<Vec<bool>> {
    fixed.roles.as_ref()?;
    let along = |axis: usize| -> Vec<bool> {
        let mut all = vec![true; sample.at[axis].len()];
        for input in truth.spec.inputs {
            for reading in fixed.readings(axis, *input) {
                let nodes = sample.nodes(axis, &reading);
                let own: Vec<bool> = nodes.iter().map(|x| truth.judges(lobe, *input, *x)).collect();
                if own.iter().filter(|o| **o).count() * LEAST_OF_ARGUMENT >= own.len() {
                    all.iter_mut().zip(own).for_each(|(all, own)| *all &= own);
                }
            }
        }
        all
    };
    let along: Vec<Vec<bool>> = (0..sample.at.len()).map(along).collect();
    let mask = everywhere(along.iter().map(Vec::as_slice));
    let few = mask.iter().filter(|m| **m).count() * LEAST_OF_ARGUMENT < mask.len();
    (!few).then_some(mask)
}

/// What is judged under a reading as it is ranked: all that is shared, or nothing where the reading
/// leaves out a part of it.
pub(super) fn ranked(own: Vec<bool>, shared: Option<&Vec<bool>>) -> Vec<bool> {
    match shared {
        Some(shared) if shared.iter().zip(&own).all(|(shared, own)| !shared || *own) => shared.clone(),
        Some(shared) => vec![false; shared.len()],
        None => own,
    }
}

/// What the channels hold, and how well that fits.
#[derive(Clone, Debug)]
pub(super) struct Fitted {
    /// By live channel.
    pub columns: Vec<Option<Column>>,
    /// By live channel; none for one that is not judged.
    pub misfits: Vec<Option<Misfit>>,
    /// Geometric mean of the ranks.
    pub rank: f64,
    /// Texels judged.
    pub texels: usize,
}

/// A reading under which fewer than one texel in this many has a truth is no reading, unless the
/// user gives it.
const LEAST_SHARE: usize = 3;

/// The best columns of the channels, whose `values` are given, and which of them are of an f0 of 1, for given
/// base values; none if no texel is judged, or few are.
pub(super) fn fit_columns(
    (values, at_one): (&[Vec<f64>], &[bool]),
    base: &Values,
    judged: &[bool],
    fixed: &Fixed,
    columns: &'static [Column],
) -> Option<Fitted> {
    let texels: Vec<usize> = (0..base.len()).filter(|i| judged[*i]).collect();
    let few = fixed.axes.is_none() && fixed.roles.is_none() && texels.len() * LEAST_SHARE < base.len();
    if texels.is_empty() || few {
        return None;
    }
    // One truth per column, whatever number of channels is held against it.
    let truths: Vec<OnceCell<Vec<f64>>> = columns.iter().map(|_| OnceCell::new()).collect();
    let here: Values = texels.iter().map(|i| base[*i]).collect();
    let truth = |column: Column| {
        let made = || here.iter().map(|base| column.value(*base)).collect::<Vec<f64>>();
        let place = columns.iter().position(|c| *c == column)?;
        Some(truths[place].get_or_init(made))
    };
    let told = |k: usize| fixed.told.get(k).copied().flatten();
    let best = |k: usize, channel: &Vec<f64>| {
        let own: Vec<f64> = texels.iter().map(|i| channel[*i]).collect();
        // The first of the columns that fit best; those of which two sums tell that they do not are
        // passed over.
        let least = |tried: &[Column]| {
            work::compared(tried.len() * own.len());
            let mut best: Option<(Column, Misfit)> = None;
            for column in tried {
                let truth = truth(*column)?;
                let known = best.map_or(f64::INFINITY, |b| b.1.rank());
                if Misfit::least_rank(&own, truth) > known {
                    continue;
                }
                let errors = own.iter().zip(truth).map(|(value, truth)| value - truth);
                let found = Misfit::of(&errors.collect::<Vec<f64>>());
                // A ratio is 0/0 where a lobe sends nothing, and fits nothing there.
                if best.is_none_or(|b| found.rank() < b.1.rank() || b.1.rank().is_nan()) {
                    best = Some((*column, found));
                }
            }
            best
        };
        match (&fixed.meanings, fixed.column) {
            (Some(given), _) => given[k].and_then(|column| least(&[column])),
            (None, Some(column)) => least(&[column]),
            (None, None) => {
                let (fixed, mut plain): (Vec<Column>, Vec<Column>) =
                    columns.iter().partition(|c| c.is_fixed());
                plain.retain(|column| !(at_one[k] && column.is_part()));
                let plain = least(&plain);
                let clear = |f: &(Column, Misfit)| plain.is_none_or(|p| CLEAR * f.1.rank() < p.1.rank());
                // A channel beside another holds a part of the split sum, not all of it.
                let alone = values.len() == 1;
                let found = alone.then(|| least(&fixed)).flatten().filter(clear).or(plain);
                // What its name tells is taken unless another is right beyond doubt.
                let told = told(k).and_then(|column| least(&[column]));
                let is_held =
                    |own: &(Column, Misfit)| found.is_none_or(|f| own.1.rank() <= BEYOND_DOUBT * f.1.rank());
                told.filter(is_held).or(found)
            }
        }
    };
    let mut fits: Vec<Option<(Column, Misfit)>> =
        values.iter().enumerate().map(|(k, channel)| best(k, channel)).collect();
    if fixed.meanings.is_none() && fixed.column.is_some() {
        keep_best(&mut fits);
    }
    let ranks: Vec<f64> = fits.iter().flatten().map(|(_, m)| m.rank()).collect();
    if ranks.iter().any(|r| !r.is_finite()) {
        return None;
    }
    let product = ranks.iter().fold(1.0, |p: f64, r| p * r);
    // A reading that takes texels out of the domain must not gain by it.
    let share = texels.len() as f64 / base.len() as f64;
    let open = fixed.meanings.is_none() && fixed.column.is_none();
    let rare = fits.iter().flatten().filter(|(column, _)| open && column.is_rare()).count();
    let share = share / (CLEAR * rare as f64).max(1.0);
    let rank = lobefit_math::ops::pow(product, 1.0 / ranks.len().max(1) as f64) / share;
    let (columns, misfits) = (fits.iter().map(|f| f.map(|f| f.0)), fits.iter().map(|f| f.map(|f| f.1)));
    Some(Fitted { columns: columns.collect(), misfits: misfits.collect(), rank, texels: texels.len() })
}

/// Of channels fitted to one column, the one that fits it.
fn keep_best(fits: &mut [Option<(Column, Misfit)>]) {
    let rank = |f: &Option<(Column, Misfit)>| f.map_or(f64::INFINITY, |f| f.1.rank());
    let best = (0..fits.len()).min_by(|a, b| rank(&fits[*a]).total_cmp(&rank(&fits[*b])));
    for (i, fit) in fits.iter_mut().enumerate() {
        if Some(i) != best {
            *fit = None;
        }
    }
}

/// A convention with its figures.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub axes: Vec<AxisReading>,
    /// Place of the lobe among the truth's.
    pub lobe: usize,
    pub fitted: Fitted,
}

impl Candidate {
    /// For readers; `channels` of the table, of which `live` vary.
    pub(super) fn convention(&self, truth: &Truth, live: &[usize], channels: usize) -> Convention {
        let mut columns = vec![None; channels];
        for (place, column) in live.iter().zip(&self.fitted.columns) {
            columns[*place] = *column;
        }
        Convention { axes: self.axes.clone(), lobe: truth.lobes[self.lobe], columns }
    }

    /// Whether two differ in clamps alone.
    pub(super) fn like(&self, other: &Candidate) -> bool {
        self.lobe == other.lobe
            && self.fitted.columns == other.fitted.columns
            && self.axes.iter().zip(&other.axes).all(|(a, b)| a.like(b))
    }
}
