//! A table that was made larger from a smaller one, by repeating texels or by linear interpolation between
//! them: it takes the memory of its size, and its error is that of the smaller.

use std::fmt;

use super::defects::stored;
use super::table::{AuditedTable, Source};
use crate::foreign::{Step, words};

/// Texels of smaller tables along an axis whose outermost stand at those of the larger one; with the
/// centres of both aligned every divisor of its size from [`LEAST`] on is tried.
const CORNERS: [usize; 7] = [8, 16, 32, 64, 128, 256, 512];

/// Least texels of the smaller table along an axis, and least times that the larger one has as many.
const LEAST: usize = 4;
const TIMES: usize = 2;

/// Texels that are looked at along an axis, in lines evenly spaced: damage elsewhere is not this one's to
/// find.
const LOOKED_AT: usize = 1 << 17;

/// Share of the sharpest bend along an axis that lines between texels of the smaller table may be bent by.
/// Where a table was computed at its own size, bends are as sharp between those as at them.
const STRAIGHT: f64 = 1e-3;

/// Steps of rounding that the values of one bend are apart at most: extrapolation to a knot from two texels
/// on each side of it takes twice four halves.
const ROUNDED: f64 = 8.0;

/// Root mean square of bends between knots beside that of rounding, and of bends at knots beside that, from
/// which on rounding explains the ones and not the others.
const LEVEL: f64 = 1.3;
const SHARPER: f64 = 1.2;

/// The same where few bends stand at knots, and fewest: of few, chance makes some sharper.
const SHARPER_OF_FEW: f64 = 1.5;
const MANY: f64 = 2048.0;
const FEWEST: f64 = 256.0;

/// The smaller table.
#[derive(Clone, Debug, PartialEq)]
pub struct Enlarged {
    /// Its size.
    pub from: Vec<usize>,
    /// Whether values between its texels are interpolated, along some axis.
    pub linear: bool,
}

impl Enlarged {
    /// The smaller table of which all channels that vary were made.
    pub(super) fn of(table: &AuditedTable, live: &[usize]) -> Option<Enlarged> {
        let mut found = Enlarged { from: table.size.clone(), linear: false };
        let axes = if table.source == Source::Table { table.size.len() } else { 0 };
        for axis in 0..axes {
            let lines: Vec<Lines> = live.iter().map(|k| Lines::of(table, *k, axis)).collect();
            let n = table.size[axis];
            let all = |made: &dyn Fn(&Lines) -> bool| lines.iter().all(made);
            let divisors = (LEAST..=n / TIMES).filter(|from| n.is_multiple_of(*from));
            if let Some(from) = divisors.clone().find(|from| all(&|lines| lines.are_repeated(n / from))) {
                found.from[axis] = from;
                continue;
            }
            let centred = divisors.map(|from| Knots::centred(from, n));
            let corners =
                CORNERS.into_iter().filter(|from| TIMES * from <= n).map(|from| Knots::ends(from, n));
            let is_made = |knots: &Knots| all(&|lines| lines.are_straight(knots) && lines.bend_at(knots));
            if let Some(knots) = centred.chain(corners).find(is_made) {
                (found.from[axis], found.linear) = (knots.count, true);
            }
        }
        found.alike(table, live);
        (found.from != table.size).then_some(found)
    }
}

impl Enlarged {
    /// Where one axis was made larger by lines, the others by the same factor, though formats hide bends.
    fn alike(&mut self, table: &AuditedTable, live: &[usize]) {
        let times = self.from.iter().zip(&table.size).map(|(from, n)| n / from).find(|times| *times >= TIMES);
        let Some(times) = times.filter(|_| self.linear) else { return };
        for (axis, n) in table.size.iter().enumerate() {
            if self.from[axis] == *n && n.is_multiple_of(times) && n / times >= LEAST {
                let knots = Knots::centred(n / times, *n);
                if live.iter().all(|k| Lines::of(table, *k, axis).are_straight(&knots)) {
                    self.from[axis] = knots.count;
                }
            }
        }
    }
}

impl fmt::Display for Enlarged {
    /// `32 x 64 texels enlarged by linear interpolation`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let how = if self.linear { "linear interpolation" } else { "repeating them" };
        write!(f, "{} texels enlarged by {how}", words(&self.from))
    }
}

/// Where the texels of a smaller table stand among those of the larger one.
struct Knots {
    count: usize,
    first: f64,
    step: f64,
}

impl Knots {
    /// The centres of both cover the same range.
    fn centred(count: usize, n: usize) -> Knots {
        let step = n as f64 / count as f64;
        Knots { count, first: 0.5 * (step - 1.0), step }
    }

    /// The outermost are the same.
    fn ends(count: usize, n: usize) -> Knots {
        Knots { count, first: 0.0, step: (n - 1) as f64 / (count - 1) as f64 }
    }

    fn at(&self, k: usize) -> f64 {
        self.first + self.step * k as f64
    }
}

/// The values of a channel line by line along an axis, the line with the sharpest bend first: most tables are
/// told there to be no enlarged ones.
struct Lines<'a> {
    values: &'a [f64],
    /// Texels of a line, and the step from one to the next.
    n: usize,
    step: usize,
    /// The first texel of each.
    first: Vec<usize>,
    /// The largest second difference.
    bend: f64,
    /// To what they are rounded, and the largest magnitude of all.
    format: Step,
    largest: f64,
}

impl<'a> Lines<'a> {
    fn of(table: &'a AuditedTable, channel: usize, axis: usize) -> Lines<'a> {
        let (size, values) = (&table.size, table.channels[channel].values.as_slice());
        let (n, step) = (size[axis], size[..axis].iter().product());
        let count = values.len() / n;
        // Odd, as sizes are even: every 128th line of 256 x 256 lies at two rows.
        let every = values.len().div_ceil(LOOKED_AT.max(n)) | 1;
        let first = (0..count).step_by(every).map(|line| line / step * n * step + line % step);
        let format = stored(table.step, values);
        let mut lines =
            Lines { values, n, step, first: first.collect(), bend: 0.0, format, largest: largest(values) };
        let bends = lines.each().map(|line| line.windows(3).map(second).fold(0.0, f64::max));
        let (sharpest, bend) =
            bends.enumerate().fold((0, 0.0), |most, own| if own.1 > most.1 { own } else { most });
        lines.first.swap(0, sharpest);
        Lines { bend, ..lines }
    }

    fn each(&self) -> impl Iterator<Item = Vec<f64>> {
        self.first.iter().map(|first| (0..self.n).map(|k| self.values[first + k * self.step]).collect())
    }

    /// What rounding leaves of a bend between values up to the largest of some.
    fn rounding(&self, largest: f64) -> f64 {
        ROUNDED * self.format.rounding(largest) + 1e-6 * largest
    }

    /// Whether texels stand in groups of equals.
    fn are_repeated(&self, times: usize) -> bool {
        let is_one = |group: &[f64]| group.iter().all(|value| *value == group[0]);
        self.bend > 0.0 && self.each().all(|line| line.chunks(times).all(is_one))
    }

    /// Whether all between the knots are straight lines, which meet at the knots, and all beyond is level.
    fn are_straight(&self, knots: &Knots) -> bool {
        let last = knots.count - 1;
        let (low, high) = (knots.at(0).ceil() as usize, knots.at(last).floor() as usize);
        let level = |part: &[f64], left: f64| part.windows(2).all(|w| (w[0] - w[1]).abs() <= left);
        let straight = |line: &[f64], k: usize, left: f64| {
            let inside = knots.at(k).ceil() as usize..=knots.at(k + 1).floor() as usize;
            line[inside].windows(3).all(|w| second(w) <= left)
        };
        let meet = |line: &[f64], k: usize, left: f64| {
            let at = knots.at(k);
            let (before, after) = (at.floor() as usize, at.ceil() as usize);
            let beyond = |a: usize, b: usize| line[a] + (line[a] - line[b]) * (at - a as f64).abs();
            before == after || (beyond(before, before - 1) - beyond(after, after + 1)).abs() <= left
        };
        // Texels beyond the outermost knots hold what stands at those.
        let held = |line: &[f64], [end, a, b]: [usize; 3], knot: f64, left: f64| {
            (line[a] + (line[a] - line[b]) * (knot - a as f64).abs() - line[end]).abs() <= left
        };
        let is_made = |line: Vec<f64>| {
            let left = STRAIGHT * self.bend + self.rounding(largest(&line));
            let ends = level(&line[..low], left) && level(&line[high + 1..], left);
            let held = low == 0
                || held(&line, [low - 1, low, low + 1], knots.at(0), left)
                    && held(&line, [high + 1, high, high - 1], knots.at(last), left);
            ends && held
                && (0..last).all(|k| straight(&line, k, left))
                && (1..last).all(|k| meet(&line, k, left))
        };
        self.each().all(is_made)
    }

    /// Whether lines bend at the knots and between them no more than rounding makes them: by far at the
    /// sharpest bend, or on average over all.
    fn bend_at(&self, knots: &Knots) -> bool {
        if self.bend > ROUNDED * (STRAIGHT * self.bend + self.rounding(self.largest)) {
            return true;
        }
        // Of three texels in a row the outer two are on one side of every knot, or on both of one.
        let within = |i: usize| {
            let side = |i: usize| ((i as f64 - knots.first) / knots.step).floor();
            side(i - 1) == side(i + 1) || (i as f64 + 1.0 - knots.first) % knots.step == 0.0
        };
        let (low, high) = (knots.at(0).ceil() as usize + 1, knots.at(knots.count - 1).floor() as usize);
        let inside: Vec<bool> = (0..self.n).map(|i| i > 0 && within(i)).collect();
        let (mut squares, mut counts, mut rounded) = ([0.0; 2], [0.0; 2], 0.0);
        for line in self.each() {
            for i in low..high {
                let (k, bend) = (usize::from(inside[i]), second(&line[i - 1..=i + 1]));
                (squares[k], counts[k]) = (squares[k] + bend * bend, counts[k] + 1.0);
                // A second difference of values that are off by up to so much, evenly.
                let half = if inside[i] { self.format.rounding(line[i]) } else { 0.0 };
                rounded += 2.0 * half * half;
            }
        }
        let is_level = squares[1] <= LEVEL * LEVEL * rounded;
        let sharper = if counts[0] < MANY { SHARPER_OF_FEW } else { SHARPER };
        let is_sharp =
            squares[0] > 0.0 && squares[0] * counts[1] >= sharper * sharper * squares[1] * counts[0];
        counts[0] >= FEWEST && counts[1] >= counts[0] && is_level && is_sharp
    }
}

/// The largest magnitude.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// The second difference of three values.
fn second(w: &[f64]) -> f64 {
    (w[0] - 2.0 * w[1] + w[2]).abs()
}
