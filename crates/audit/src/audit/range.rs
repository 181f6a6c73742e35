//! The range of an index of refraction that a table does not state, as its slices show it.

use super::axis::{AxisReading, Input, Registration, Scale};
use super::best::Case;
use super::judge::rejudge;
use super::sample::{Candidate, Sample, Tensor, assigned, nodes};
use super::screen::best;
use super::table::Source;
use super::truth::Truth;
use super::{AuditError, CLEAR};

/// Places along every axis at which slices are held against the truth.
const PLACES: usize = 8;

/// Indices of refraction between which a range is looked for: every 0.025 from 1 to 3.
const INDICES: usize = 81;

/// Readings of the other axes that are tried, and those of them whose ranges are looked at closely.
const TRIED: usize = 64;
const CLOSELY: usize = 4;

/// Share of an index to which an end of a range is looked for.
const NARROW: f64 = 1e-4;

/// Least that ends differ by: a table over less is of one index.
const LEAST: f64 = 0.05;

/// What ends are rounded to: whoever makes a table takes them round.
const ROUND: [f64; 5] = [0.1, 0.05, 0.01, 1e-3, 1e-4];

/// The conventions that were found, and before them those with the range that the slices show, where that is
/// clearly better.
pub(super) fn shown(
    truth: &Truth,
    case: &Case,
    sample: &Sample,
    found: Vec<Candidate>,
) -> Result<Vec<Candidate>, AuditError> {
    let Case { table, live, fixed, progress } = *case;
    let Some(first) = found.first().filter(|_| table.source == Source::Table) else {
        return Ok(found);
    };
    if fixed.axes.is_some() || axis_of(first).is_none() {
        return Ok(found);
    }
    progress("which range the index has");
    // What lies at an end may be clamped, or at a cosine of no truth.
    let few = Sample::new(table, live, PLACES, table.size.iter().all(|n| *n > PLACES / 2));
    let mut other: Vec<&Candidate> = Vec::new();
    for candidate in &found {
        let is_new = !other.iter().any(|o| is_like(o, candidate)) && !truth.lobes[candidate.lobe].both;
        if is_new && other.len() < TRIED {
            other.push(candidate);
        }
    }
    let of = |candidate: &Candidate| Slices { truth, few: &few, candidate: candidate.clone() }.range();
    let mut ranges = other.into_iter().map(of).collect::<Result<Vec<_>, _>>()?;
    ranges.retain(|range| range.square.is_finite());
    ranges.sort_by(|a, b| a.square.total_cmp(&b.square));
    ranges.truncate(CLOSELY);
    let mut tried = Vec::new();
    for range in ranges {
        let ends = range.narrowed()?;
        let registrations = fixed.readings(range.slices.axis(), Input::Ior);
        let is_open = |r: &Registration| registrations.iter().any(|own| own.registration == *r);
        for registration in [Registration::Endpoint, Registration::Centre].into_iter().filter(is_open) {
            tried.extend(range.slices.rounded(ends, registration));
        }
    }
    let tried = best(rejudge(truth, sample, fixed, tried, Truth::quick)?, CLOSELY * ROUND.len());
    let clear = tried.first().is_some_and(|t| CLEAR * t.fitted.rank < found[0].fitted.rank);
    Ok(if clear { best([tried, found].concat(), usize::MAX) } else { found })
}

/// The axis that an index runs along.
fn axis_of(candidate: &Candidate) -> Option<usize> {
    candidate.axes.iter().position(|axis| axis.scale.input() == Input::Ior)
}

/// Whether two read everything but the index alike.
fn is_like(one: &Candidate, other: &Candidate) -> bool {
    let is_same = |(a, b): (&AxisReading, &AxisReading)| {
        a == b || a.scale.input() == Input::Ior && b.scale.input() == Input::Ior
    };
    (one.lobe, &one.fitted.columns) == (other.lobe, &other.fitted.columns)
        && one.axes.iter().zip(&other.axes).all(is_same)
}

/// The sum of what slices leave without the largest: one may be of another index.
fn but_the_worst(slices: impl Iterator<Item = f64>) -> f64 {
    let (sum, most) = slices.fold((0.0, 0.0_f64), |(sum, most), square| (sum + square, most.max(square)));
    sum - most
}

/// The slices of a table along its index, under a reading of everything else.
struct Slices<'a> {
    truth: &'a Truth<'a>,
    few: &'a Sample,
    candidate: Candidate,
}

/// The range that fits best.
struct Range<'a> {
    slices: Slices<'a>,
    /// The indices of the first and the last slice.
    ends: [f64; 2],
    /// Sum of the squares of the errors.
    square: f64,
}

impl<'a> Slices<'a> {
    fn axis(&self) -> usize {
        axis_of(&self.candidate).unwrap_or(0)
    }

    /// Sums of the squares of the errors of every slice, if it is of each of these indices.
    fn squares(&self, indices: &[f64]) -> Result<Vec<Vec<f64>>, AuditError> {
        let Slices { truth, few, candidate } = self;
        let (axis, mut dims) = (self.axis(), few.dims());
        let slices = dims[axis];
        let assigned = assigned(truth, &candidate.axes);
        let own = |k: usize| if k == axis { indices.to_vec() } else { few.nodes(k, &candidate.axes[k]) };
        let nodes = nodes(truth, candidate.lobe, &assigned, own);
        let tensor = Tensor::new(truth, candidate.lobe, &nodes, &assigned, Truth::quick)?;
        let below: usize = dims[..axis].iter().product();
        dims[axis] = 1;
        let mut squares = vec![vec![0.0; indices.len()]; slices];
        for j in 0..indices.len() {
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
        let axis = self.axis();
        let last = (self.few.size[axis] - 1).max(1) as f64;
        self.few.at[axis].iter().map(|k| *k as f64 / last).collect()
    }

    fn range(self) -> Result<Range<'a>, AuditError> {
        let index = |j: usize| 1.0 + 2.0 * j as f64 / (INDICES - 1) as f64;
        let squares = self.squares(&(0..INDICES).map(index).collect::<Vec<_>>())?;
        let shares = self.shares();
        let mut found = ([1.0; 2], f64::INFINITY);
        for [low, high] in (0..INDICES).flat_map(|a| (0..INDICES).map(move |b| [a, b])) {
            let at = |share: f64| (low as f64 + (high as f64 - low as f64) * share).round() as usize;
            let square = but_the_worst(shares.iter().zip(&squares).map(|(share, of)| of[at(*share)]));
            if square < found.1 {
                found = ([low, high].map(index), square);
            }
        }
        Ok(Range { slices: self, ends: found.0, square: found.1 })
    }

    /// The reading with these indices of the first and the last slice, as ends of the axis are rounded.
    fn rounded(&self, [first, last]: [f64; 2], registration: Registration) -> Vec<Candidate> {
        let axis = self.axis();
        let size = self.few.size[axis];
        let [low, high] = [0, size - 1].map(|k| registration.coordinate(k, size));
        let slope = (last - first) / (high - low);
        let ends = [first - slope * low, first + slope * (1.0 - low)];
        let with = |unit: &f64| {
            let mut candidate = self.candidate.clone();
            // The unit's inverse is whole, so that a round number is the nearest to itself.
            let ends = ends.map(|end| (end / unit).round() / (1.0 / unit).round());
            candidate.axes[axis] =
                AxisReading::new(Scale::between(Input::Ior, ends, false), registration, false);
            ((ends[1] - ends[0]).abs() >= LEAST).then_some(candidate)
        };
        ROUND.iter().filter_map(with).collect()
    }
}

impl Range<'_> {
    /// The ends, looked for between the indices that were tried.
    fn narrowed(&self) -> Result<[f64; 2], AuditError> {
        let shares = self.slices.shares();
        let square = |[low, high]: [f64; 2]| -> Result<f64, AuditError> {
            let indices: Vec<f64> = shares.iter().map(|share| low + (high - low) * share).collect();
            let squares = self.slices.squares(&indices)?;
            Ok(but_the_worst((0..indices.len()).map(|k| squares[k][k])))
        };
        let (mut ends, mut width) = (self.ends, 2.0 / (INDICES - 1) as f64);
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
