//! The range of an index of refraction or of a roughness that a table does not state, as its slices show it.

use super::axis::{AxisReading, Input, Registration, Scale};
use super::best::Case;
use super::convention::Misfit;
use super::judge::rejudge;
use super::preferred::BEYOND_DOUBT;
use super::sample::{Candidate, Sample, Tensor, assigned, nodes};
use super::screen::best;
use super::table::Source;
use super::truth::Truth;
use super::{AuditError, CLEAR, FITS};

/// Places along every axis at which slices are held against the truth.
const PLACES: usize = 8;

/// Readings of the other axes that are tried, and those of them whose ranges are looked at closely.
const TRIED: usize = 64;
const CLOSELY: usize = 4;

/// How closely an end of a range is looked for.
const NARROW: f64 = 1e-4;

/// Least that ends differ by: a table over less is of one index or roughness.
const LEAST: f64 = 0.05;

/// How near to those of a whole range its ends are no range of their own.
const WHOLE: f64 = 0.01;

/// Misfit of a table that needs no other range.
const NEAR: f64 = 0.02 * FITS;

/// What ends are rounded to: whoever makes a table takes them round.
const ROUND: [f64; 5] = [0.1, 0.05, 0.01, 1e-3, 1e-4];

/// The conventions that were found, and before them those with the ranges that the slices show, where these
/// are clearly better.
pub(super) fn shown(
    truth: &Truth,
    case: &Case,
    sample: &Sample,
    found: Vec<Candidate>,
) -> Result<Vec<Candidate>, AuditError> {
    SOUGHT.iter().try_fold(found, |found, sought| sought.shown(truth, case, sample, found))
}

/// What slices lie evenly along, and whose range a table may not state.
struct Sought {
    /// In messages.
    name: &'static str,
    /// The input that it tells.
    input: Input,
    /// The input at a value of it.
    input_at: fn(f64) -> f64,
    /// The coordinate between two ends.
    between: fn([f64; 2]) -> Scale,
    /// Between which values ends are first looked for, and at how many.
    grid: ([f64; 2], usize),
    /// The range that tables have of themselves.
    whole: Option<[f64; 2]>,
    /// How much better another range must rank to be taken: where tables have one of themselves, an error
    /// that grows along the axis is like another end of it.
    gain: f64,
}

const SOUGHT: [Sought; 2] = [
    Sought {
        name: "index",
        input: Input::Ior,
        input_at: |ior| ior,
        between: |ends| Scale::between(Input::Ior, ends, false),
        grid: ([1.0, 3.0], 81),
        whole: None,
        gain: CLEAR,
    },
    Sought {
        name: "roughness",
        input: Input::Alpha,
        input_at: |roughness| roughness * roughness,
        between: |ends| Scale::between_roughnesses(ends, false),
        grid: ([0.0, 1.0], 41),
        whole: Some([0.0, 1.0]),
        gain: BEYOND_DOUBT,
    },
];

impl Sought {
    /// The axis that it runs along.
    fn axis_of(&self, candidate: &Candidate) -> Option<usize> {
        candidate.axes.iter().position(|axis| axis.scale.input() == self.input)
    }

    /// Whether two read everything else alike.
    fn is_like(&self, one: &Candidate, other: &Candidate) -> bool {
        let is_own = |axis: &AxisReading| axis.scale.input() == self.input;
        let is_same = |(a, b): (&AxisReading, &AxisReading)| a == b || is_own(a) && is_own(b);
        (one.lobe, &one.fitted.columns) == (other.lobe, &other.fitted.columns)
            && one.axes.iter().zip(&other.axes).all(is_same)
    }

    /// The distance of two values that are first looked at.
    fn step(&self) -> f64 {
        let ([low, high], values) = self.grid;
        (high - low) / (values - 1) as f64
    }

    /// Whether ends make a range of their own.
    fn is_range(&self, ends: [f64; 2]) -> bool {
        let Some(whole) = self.whole else { return (ends[1] - ends[0]).abs() >= LEAST };
        let beyond = |end: &f64| !(whole[0]..=whole[1]).contains(end);
        // In binary 1 - 0.99 is above 0.01.
        let near = |(end, whole): (f64, f64)| (end - whole).abs() < WHOLE + 0.5 * NARROW;
        (ends[1] - ends[0]).abs() >= LEAST
            && !ends.iter().any(beyond)
            && !ends.into_iter().zip(whole).all(near)
    }

    /// [`shown`], of this one.
    fn shown(
        &self,
        truth: &Truth,
        case: &Case,
        sample: &Sample,
        found: Vec<Candidate>,
    ) -> Result<Vec<Candidate>, AuditError> {
        let Case { table, live, fixed, progress } = *case;
        let Some(first) = found.first().filter(|_| table.source == Source::Table) else {
            return Ok(found);
        };
        let is_near = |misfit: &Option<Misfit>| misfit.is_none_or(|misfit| misfit.trimmed <= NEAR);
        let has_range = first.fitted.misfits.iter().all(is_near);
        if fixed.axes.is_some() || has_range || self.axis_of(first).is_none() {
            return Ok(found);
        }
        progress(&format!("which range the {} has", self.name));
        // What lies at an end may be clamped, or at a cosine of no truth.
        let few = Sample::new(table, live, PLACES, table.size.iter().all(|n| *n > PLACES / 2));
        let mut other: Vec<&Candidate> = Vec::new();
        for candidate in &found {
            let is_new =
                !other.iter().any(|o| self.is_like(o, candidate)) && !truth.lobes[candidate.lobe].both;
            if is_new && other.len() < TRIED {
                other.push(candidate);
            }
        }
        let of = |candidate: &Candidate| {
            let axis = self.axis_of(candidate)?;
            Some(Slices { truth, few: &few, candidate: candidate.clone(), sought: self, axis }.range())
        };
        let mut ranges = other.into_iter().filter_map(of).collect::<Result<Vec<_>, _>>()?;
        ranges.retain(|range| range.square.is_finite());
        ranges.sort_by(|a, b| a.square.total_cmp(&b.square));
        ranges.truncate(CLOSELY);
        let mut tried = Vec::new();
        for range in ranges {
            let ends = range.narrowed()?;
            let registrations = fixed.readings(range.slices.axis, self.input);
            let is_open = |r: &Registration| registrations.iter().any(|own| own.registration == *r);
            for registration in [Registration::Endpoint, Registration::Centre].into_iter().filter(is_open) {
                tried.extend(range.slices.rounded(ends, registration));
            }
        }
        let tried = best(rejudge(truth, sample, fixed, tried, Truth::quick)?, CLOSELY * ROUND.len());
        let clear = tried.first().is_some_and(|t| self.gain * t.fitted.rank < found[0].fitted.rank);
        Ok(if clear { best([tried, found].concat(), usize::MAX) } else { found })
    }
}

/// The sum of what slices leave without the largest: one may be of another value.
fn but_the_worst(slices: impl Iterator<Item = f64>) -> f64 {
    let (sum, most) = slices.fold((0.0, 0.0_f64), |(sum, most), square| (sum + square, most.max(square)));
    sum - most
}

/// The slices of a table along an axis, under a reading of every other.
struct Slices<'a> {
    truth: &'a Truth<'a>,
    few: &'a Sample,
    candidate: Candidate,
    sought: &'a Sought,
    axis: usize,
}

/// The range that fits best.
struct Range<'a> {
    slices: Slices<'a>,
    /// The values of the first and the last slice.
    ends: [f64; 2],
    /// Sum of the squares of the errors.
    square: f64,
}

impl<'a> Slices<'a> {
    /// Sums of the squares of the errors of every slice, if it is of each of these values.
    fn squares(&self, values: &[f64]) -> Result<Vec<Vec<f64>>, AuditError> {
        let Slices { truth, few, candidate, sought, axis } = self;
        let (axis, mut dims) = (*axis, few.dims());
        let slices = dims[axis];
        let assigned = assigned(truth, &candidate.axes);
        let inputs: Vec<f64> = values.iter().map(|value| (sought.input_at)(*value)).collect();
        let own = |k: usize| if k == axis { inputs.clone() } else { few.nodes(k, &candidate.axes[k]) };
        let nodes = nodes(truth, candidate.lobe, &assigned, own);
        let tensor = Tensor::new(truth, candidate.lobe, &nodes, &assigned, Truth::quick)?;
        let below: usize = dims[..axis].iter().product();
        dims[axis] = 1;
        let mut squares = vec![vec![0.0; values.len()]; slices];
        for j in 0..values.len() {
            let plane = tensor.gathered(j * tensor.steps[axis], &dims);
            for (channel, column) in few.values.iter().zip(&candidate.fitted.columns) {
                let Some(column) = column else { continue };
                let truths: Vec<f64> = plane.iter().map(|base| column.value(*base)).collect();
                for (i, value) in channel.iter().enumerate() {
                    let (slice, within) = (i / below % slices, i % below + i / (below * slices) * below);
                    squares[slice][j] += (value - truths[within]) * (value - truths[within]);
                }
            }
        }
        Ok(squares)
    }

    /// How far along the axis every slice lies, of 1.
    fn shares(&self) -> Vec<f64> {
        let last = (self.few.size[self.axis] - 1).max(1) as f64;
        self.few.at[self.axis].iter().map(|k| *k as f64 / last).collect()
    }

    fn range(self) -> Result<Range<'a>, AuditError> {
        let ([least, _], values) = self.sought.grid;
        let value = |j: usize| least + self.sought.step() * j as f64;
        let squares = self.squares(&(0..values).map(value).collect::<Vec<_>>())?;
        let shares = self.shares();
        let mut found = ([least; 2], f64::INFINITY);
        for [low, high] in (0..values).flat_map(|a| (0..values).map(move |b| [a, b])) {
            let at = |share: f64| (low as f64 + (high as f64 - low as f64) * share).round() as usize;
            let square = but_the_worst(shares.iter().zip(&squares).map(|(share, of)| of[at(*share)]));
            if square < found.1 {
                found = ([low, high].map(value), square);
            }
        }
        Ok(Range { slices: self, ends: found.0, square: found.1 })
    }

    /// The reading with these values of the first and the last slice, as ends of the axis are rounded.
    fn rounded(&self, [first, last]: [f64; 2], registration: Registration) -> Vec<Candidate> {
        let (axis, size) = (self.axis, self.few.size[self.axis]);
        let [low, high] = [0, size - 1].map(|k| registration.coordinate(k, size));
        let slope = (last - first) / (high - low);
        let ends = [first - slope * low, first + slope * (1.0 - low)];
        let with = |unit: &f64| {
            let mut candidate = self.candidate.clone();
            // The unit's inverse is whole, so that a round number is the nearest to itself; 0 makes 0 of -0.
            let ends = ends.map(|end| (end / unit).round() / (1.0 / unit).round() + 0.0);
            candidate.axes[axis] = AxisReading::new((self.sought.between)(ends), registration, false);
            self.sought.is_range(ends).then_some(candidate)
        };
        ROUND.iter().filter_map(with).collect()
    }
}

impl Range<'_> {
    /// The ends, looked for between the values that were tried.
    fn narrowed(&self) -> Result<[f64; 2], AuditError> {
        let shares = self.slices.shares();
        let square = |[low, high]: [f64; 2]| -> Result<f64, AuditError> {
            let values: Vec<f64> = shares.iter().map(|share| low + (high - low) * share).collect();
            let squares = self.slices.squares(&values)?;
            Ok(but_the_worst((0..values.len()).map(|k| squares[k][k])))
        };
        let (mut ends, mut width) = (self.ends, self.slices.sought.step());
        let mut least = square(ends)?;
        while width > NARROW {
            let mut moved = false;
            for step in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, -1.0], [-1.0, 1.0]] {
                let tried = [ends[0] + width * step[0], ends[1] + width * step[1]];
                let own = square(tried)?;
                if own < least {
                    (ends, least, moved) = (tried, own, true);
                }
            }
            if !moved {
                width *= 0.5;
            }
        }
        Ok(ends)
    }
}
