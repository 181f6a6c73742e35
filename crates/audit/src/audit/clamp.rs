//! The least values that inputs were clamped to, as the lines and the corner of a table show them.

use super::axis::{AxisReading, Input};
use super::column::Column;
use super::convention::{Fixed, Misfit};
use super::defects::SEEN;
use super::errors::{median, rms, spread};
use super::first_line::{FirstLine, STANDS_OUT, USUAL, found, largest_of, stand_out};
use super::judge::{judge, rejudge};
use super::sample::{Candidate, Fitted, Sample};
use super::truth::Truth;
use super::{AuditError, CLEAR};

/// Least values that tables clamp alpha and mu to; the last three are the first centre of 16 texels, which
/// a table keeps that was made larger, the least alpha of a sheen that Khronos ships, and that of a table of
/// Dassault's.
const FLOORS: [f64; 10] = [1e-4, 1e-3, 1e-2, 1e-5, 2e-3, 5e-3, 2e-2, 1.0 / 32.0, 7e-2, 4e-3];

/// Lines are the same that differ by no more than this share of what the table spans.
const SAME: f64 = 1e-6;

/// What a clamp makes one differs by no more than this share of what the truth does: of samples by noise.
const ALIKE: f64 = 0.2;

/// Share of what a table spans above which truths of lines that are the same differ: formats of 8 bits make
/// smooth lines one that differ by less.
const APART: f64 = 0.02;

/// One line is clamped that lies below this share of the floor.
const FAR_BELOW: f64 = 0.7;

/// The candidate with the clamps that fit best: of all its axes together, of two in a corner that shows
/// only both, then of each.
pub(super) fn with_floors(
    truth: &Truth,
    sample: &Sample,
    fixed: &Fixed,
    candidate: &Candidate,
) -> Result<Candidate, AuditError> {
    let lines = Clampable::of(truth, sample, candidate)?;
    let clipped = lines.clipped();
    if clipped.contains(&true) {
        // Values that stand at a clamp of their own say nothing of one of an input.
        let rest = Sample { left_out: clipped, ..sample.clone() };
        let bare = rejudge(truth, &rest, fixed, vec![candidate.clone()], Truth::ranked)?.pop();
        let Some(bare) = bare else { return Ok(candidate.clone()) };
        let found = with_floors(truth, &rest, fixed, &bare)?;
        let judged = rejudge(truth, sample, fixed, vec![found], Truth::ranked)?.pop();
        return Ok(judged.unwrap_or_else(|| candidate.clone()));
    }
    let copied = candidate.axes.iter().enumerate().map(|(axis, reading)| lines.copied(axis, reading));
    let search = Search { truth, sample, fixed, bare: candidate, copied: copied.collect(), lines };
    let (axes, iors) = (search.open(&[Input::Alpha, Input::Mu]), search.open(&[Input::Ior]));
    let together = |floors: &dyn Fn(usize) -> f64| -> Vec<(usize, f64)> {
        axes.iter().enumerate().map(|(k, axis)| (*axis, floors(k))).collect()
    };
    let mut at = candidate.clone();
    for floor in FLOORS {
        at = search.taken(at, &together(&|_| floor))?;
    }
    if at.axes == candidate.axes && sample.dims().len() == 2 && axes.len() == 2 && is_spiked(&at.fitted) {
        for [first, second] in FLOORS.iter().flat_map(|a| FLOORS.map(|b| [*a, b])).filter(|[a, b]| a != b) {
            at = search.taken(at, &together(&|k| [first, second][k]))?;
        }
    }
    for axis in axes.iter().chain(&iors) {
        at = search.along(at, *axis)?;
    }
    // What was looked for along one axis was so beside the clamp of the other as it was then.
    for _ in 0..AGAIN {
        if at.axes == candidate.axes || axes.len() < 2 {
            break;
        }
        let before = at.axes.clone();
        for axis in &axes {
            at = search.along(search.without(at, *axis)?, *axis)?;
        }
        if at.axes == before {
            break;
        }
    }
    axes.iter().chain(&iors).try_fold(at, |at, axis| search.rounded(at, *axis))
}

/// A search for the clamps of a reading.
struct Search<'a> {
    truth: &'a Truth<'a>,
    sample: &'a Sample,
    fixed: &'a Fixed,
    /// The reading without them.
    bare: &'a Candidate,
    lines: Clampable<'a>,
    /// By axis the input at the last of lines that are the same, below which no clamp leaves them so.
    copied: Vec<f64>,
}

impl Search<'_> {
    /// Axes of some inputs for which no clamp is stated.
    fn open(&self, inputs: &[Input]) -> Vec<usize> {
        let input = |axis: &usize| self.bare.axes[*axis].scale.input();
        let is_open = |axis: &usize| inputs.contains(&input(axis)) && self.fixed.floor(input(axis)).is_none();
        (0..self.bare.axes.len()).filter(is_open).collect()
    }

    /// An index of refraction is clamped as far above 1 as the others above 0.
    fn least(&self, axis: usize) -> f64 {
        if self.bare.axes[axis].scale.input() == Input::Ior { 1.0 } else { 0.0 }
    }

    /// A reading with floors, by axis, and whether one of them is near the one line that it clamps; none
    /// where they clamp nothing, or lines that differ.
    fn raised(
        &self,
        at: &Candidate,
        floors: &[(usize, f64)],
    ) -> Result<Option<(Candidate, bool)>, AuditError> {
        let nodes = |axis: usize| self.sample.nodes(axis, &self.bare.axes[axis]);
        let clamps = |floor: &&(usize, f64)| nodes(floor.0).into_iter().any(|node| node < floor.1);
        let floors: Vec<(usize, f64)> = floors.iter().filter(clamps).copied().collect();
        let differ = |(axis, floor): &(usize, f64)| self.lines.differ(*axis, &self.bare.axes[*axis], *floor);
        let is_beyond = |(axis, floor): &(usize, f64)| {
            let reading = &self.bare.axes[*axis];
            *floor < self.copied[*axis] || *floor > self.lines.next(*axis, reading) * (1.0 + SAME)
        };
        if floors.is_empty() || floors.iter().any(|floor| differ(floor) || is_beyond(floor)) {
            return Ok(None);
        }
        let mut clamped = at.clone();
        floors.iter().for_each(|(axis, floor)| clamped.axes[*axis].floor = *floor);
        let near = floors.iter().any(|(axis, floor)| {
            self.lines.is_near(*axis, &self.bare.axes[*axis], [self.least(*axis), *floor])
        });
        let judged = rejudge(self.truth, self.sample, self.fixed, vec![clamped], Truth::ranked)?.pop();
        Ok(judged.map(|judged| (judged, near)))
    }

    /// A reading with floors where they explain something.
    fn taken(&self, at: Candidate, floors: &[(usize, f64)]) -> Result<Candidate, AuditError> {
        let raised = self.raised(&at, floors)?;
        let mends = |t: &Candidate| is_mended(t, &at, NEARLY) && t.fitted.rank <= at.fitted.rank;
        let taken = raised.filter(|(t, near)| if *near { mends(t) } else { explains(t, &at) });
        Ok(taken.map_or(at, |(taken, _)| taken))
    }

    /// A reading without the clamp of an axis, where that is no worse.
    fn without(&self, at: Candidate, axis: usize) -> Result<Candidate, AuditError> {
        if at.axes[axis].floor == self.bare.axes[axis].floor {
            return Ok(at);
        }
        let mut bare = at.clone();
        bare.axes[axis].floor = self.bare.axes[axis].floor;
        let judged = rejudge(self.truth, self.sample, self.fixed, vec![bare], Truth::ranked)?.pop();
        let as_good = |t: &Candidate| t.fitted.rank <= at.fitted.rank && t.fitted.texels >= at.fitted.texels;
        Ok(judged.filter(as_good).unwrap_or(at))
    }

    /// Whether a line of the table, also one that is not sampled, lies at a clamp: it is what others were
    /// copied from.
    fn is_at_a_line(&self, axis: usize, floor: f64) -> bool {
        let size = self.sample.size[axis];
        let reading = &self.bare.axes[axis];
        let node = |k: usize| reading.node(k, size);
        let is_at = |k: usize| (floor - node(k)).abs() < AT_A_LINE * (node(k + 1) - node(k)).abs();
        // Who states a clamp states a round number.
        let is_meant = |k: usize| is_round(node(k)) || is_round(reading.coordinate(k, size));
        (0..size - 1).any(|k| is_at(k) && !is_meant(k))
    }

    /// The clamp of an axis that shows in its first line alone, which is off by far more than others: where
    /// it leaves the line no farther off than those, or next to nothing of what it was off, as the clamp of a
    /// line near to it must. A line may be off for other reasons, of which no clamp leaves so little.
    fn alone(&self, at: &Candidate, axis: usize) -> Result<Option<f64>, AuditError> {
        let reading = &self.bare.axes[axis];
        let (lines, nodes) =
            (self.lines.below(axis, reading, f64::INFINITY), self.sample.nodes(axis, reading));
        if lines.len() < 2 || !self.lines.held(axis, reading).is_empty() {
            return Ok(None);
        }
        // Where it crosses the first lines of another axis it is off by the clamp of that.
        let line = |is_whole: bool| {
            let kept = |(k, n): (usize, &usize)| -> Vec<usize> {
                let first = self.lines.same(k, &self.bare.axes[k]);
                let is_kept = |place: &usize| {
                    if k == axis { first.contains(place) } else { is_whole || !first.contains(place) }
                };
                (0..*n).filter(is_kept).collect()
            };
            let line = self.sample.only(&self.sample.dims().iter().enumerate().map(kept).collect::<Vec<_>>());
            FirstLine { truth: self.truth, at, axis, line }
        };
        let [most, whole] = [false, true].map(line);
        let usual = self.lines.usual(&at.fitted.columns);
        let before = most.errors(reading.floor)?;
        if !stand_out(&before, &usual, STANDS_OUT) {
            return Ok(None);
        }
        let floor = found([&most, &whole], [nodes[lines[0]], nodes[lines[1]]])?;
        let left = most.errors(floor)?;
        let is_near = self.lines.is_near(axis, reading, [self.least(axis), floor]);
        let [most, was] = [&left, &before].map(|errors| largest_of(errors));
        let explains =
            most < MENDED * was || !is_near && most < NEARLY * was && !stand_out(&left, &usual, USUAL);
        // A line that comes out far nearer to its truth than others are follows it by chance.
        let by_chance = left
            .iter()
            .zip(&usual)
            .any(|(own, usual)| *usual > SEEN && rms(own.iter().copied()) * STANDS_OUT < *usual);
        let explains = explains && !by_chance;
        Ok(explains.then_some(floor))
    }

    /// A reading with the clamp of an axis that fits best.
    fn along(&self, mut at: Candidate, axis: usize) -> Result<Candidate, AuditError> {
        for floor in FLOORS.map(|floor| self.least(axis) + floor) {
            at = self.taken(at, &[(axis, floor)])?;
        }
        self.between(at, axis)
    }

    /// A reading with a clamp of the list, or of one digit, in place of one that is near to it, where that is
    /// hardly worse: a clamp is a round number.
    fn rounded(&self, at: Candidate, axis: usize) -> Result<Candidate, AuditError> {
        let floor = at.axes[axis].floor;
        let listed = FLOORS.map(|listed| self.least(axis) + listed);
        let digit = format!("{floor:.0e}").parse().unwrap_or(floor);
        let is_near = |near: &f64| !listed.contains(&floor) && (near - floor).abs() < ROUND * floor;
        let mut best: Option<Candidate> = None;
        for near in listed.into_iter().chain([digit]).filter(is_near) {
            let raised = self.raised(&at, &[(axis, near)])?.map(|(raised, _)| raised);
            let is_as_good = |t: &Candidate| WORTH * t.fitted.rank <= at.fitted.rank;
            let is_better = |t: &Candidate| best.as_ref().is_none_or(|best| t.fitted.rank < best.fitted.rank);
            best = raised.filter(|t| is_as_good(t) && is_better(t)).or(best);
        }
        Ok(best.unwrap_or(at))
    }

    /// A reading with the clamp of an axis that its first lines, or the first alone, show between two lines.
    fn between(&self, mut at: Candidate, axis: usize) -> Result<Candidate, AuditError> {
        let seen = self.lines.held(axis, &self.bare.axes[axis]);
        if let Some(floor) = self.alone(&at, axis)? {
            // What is noise makes one number as good as another.
            let share = if at.axes[axis].floor > self.bare.axes[axis].floor { WORTH } else { 1.0 };
            let is_better =
                |t: &Candidate| t.fitted.rank < share * at.fitted.rank && t.fitted.texels >= at.fitted.texels;
            let raised = self.raised(&at, &[(axis, floor)])?.map(|(raised, _)| raised);
            return Ok(raised.filter(is_better).unwrap_or(at));
        }
        // Where no lines are the same they may be but for noise.
        let is_noisy = seen.is_empty();
        let seen =
            if is_noisy { self.lines.about(axis, &self.bare.axes[axis], at.axes[axis].floor) } else { seen };
        // Of those between two lines that explain something the nearest is taken, and looked about, and so is
        // one of the list.
        let mut width = seen.get(1).map_or(0.0, |next| next - seen[0]);
        let is_between =
            |floor: &f64| seen.first().is_some_and(|last| (*last..last + 8.0 * width).contains(floor));
        let mut nearest = Some(at.axes[axis].floor).filter(is_between);
        let raised = |at: &Candidate, floor: f64| -> Result<Option<Candidate>, AuditError> {
            Ok(self.raised(at, &[(axis, floor)])?.filter(|(_, near)| !near).map(|(raised, _)| raised))
        };
        for floor in seen.iter().copied() {
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
        // Lines that hold what the next one has of its own are copies of it.
        if let Some(floor) = nearest.filter(|floor| !is_noisy && self.is_at_a_line(axis, *floor)) {
            let beside = raised(&at, floor + seen[1] - seen[0])?;
            // Samples do not tell a clamp from another.
            if beside.is_none_or(|beside| beside.fitted.rank > CLEAR * at.fitted.rank) {
                let mut bare = at;
                bare.axes[axis].floor = self.bare.axes[axis].floor;
                let judged =
                    rejudge(self.truth, self.sample, self.fixed, vec![bare.clone()], Truth::ranked)?.pop();
                return Ok(judged.unwrap_or(bare));
            }
        }
        Ok(at)
    }
}

/// A norm of some differences.
type Norm = fn(&mut dyn Iterator<Item = f64>) -> f64;

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

    /// Median magnitude of the errors of every channel that is judged.
    fn usual(&self, columns: &[Option<Column>]) -> Vec<f64> {
        let channels = columns.iter().zip(self.truth.iter().zip(&self.sample.values));
        let of = |(truth, own): (&Vec<f64>, &Vec<f64>)| {
            median(truth.iter().zip(own).map(|(truth, own)| (own - truth).abs()).collect())
        };
        channels.filter(|(column, _)| column.is_some()).map(|(_, channel)| of(channel)).collect()
    }

    /// Which texels hold the largest value of a channel, as others do that lie on no line which is the same
    /// as the one before it, and have a truth beyond it; none of those that are left out already.
    fn clipped(&self) -> Vec<bool> {
        let count = if self.sample.left_out.is_empty() { self.sample.values[0].len() } else { 0 };
        let repeated = self.sample.repeated(&self.sample.values, 0.0);
        let mut clipped = vec![false; count];
        for (truth, own) in self.truth.iter().zip(&self.sample.values) {
            let high = own.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let beyond = high + APART * spread(own.iter().copied());
            let all: Vec<usize> = (0..count).filter(|i| own[*i] == high && truth[*i] > beyond).collect();
            if all.iter().filter(|i| !self.sample.lies_on(**i, &repeated)).count() > 1 {
                all.into_iter().for_each(|i| clipped[i] = true);
            }
        }
        clipped
    }

    /// Places along an axis at which an input is below a floor, the least first.
    fn below(&self, axis: usize, reading: &AxisReading, floor: f64) -> Vec<usize> {
        let nodes = self.sample.nodes(axis, reading);
        let mut places: Vec<usize> = (0..nodes.len()).filter(|k| nodes[*k] < floor).collect();
        places.sort_by(|a, b| nodes[*a].total_cmp(&nodes[*b]));
        places
    }

    /// A norm of the differences of lines of the table or of its truth from the first of them, beside what
    /// the values span; the largest of the channels. What stands at the largest value may be clamped itself.
    fn difference(&self, of: &[Vec<f64>], axis: usize, lines: &[usize], norm: Norm) -> f64 {
        let dims = self.sample.dims();
        let step: usize = dims[..axis].iter().product();
        let along = |i: usize| i / step % dims[axis];
        let channel = |(values, own): (&Vec<f64>, &Vec<f64>)| {
            let high = own.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let first = |i: usize| i + lines[0] * step - along(i) * step;
            let counts = |i: &usize| lines.contains(&along(*i)) && own[*i] != high && own[first(*i)] != high;
            let mut differences = (0..own.len()).filter(counts).map(|i| values[i] - values[first(i)]);
            norm(&mut differences) / spread(own.iter().copied())
        };
        of.iter().zip(&self.sample.values).map(channel).fold(0.0, f64::max)
    }

    /// Whether what a floor makes one differs nearly as much as without it.
    fn differ(&self, axis: usize, reading: &AxisReading, floor: f64) -> bool {
        let lines = self.below(axis, reading, floor);
        let rms_of = |of| self.difference(of, axis, &lines, |all| rms(all));
        lines.len() > 1 && rms_of(&self.sample.values) > SAME.max(ALIKE * rms_of(&self.truth))
    }

    /// Places along an axis of the first line, and of those after it that are the same.
    fn same(&self, axis: usize, reading: &AxisReading) -> Vec<usize> {
        let all = self.below(axis, reading, f64::INFINITY);
        match self.held(axis, reading).first() {
            Some(last) => self.below(axis, reading, last * (1.0 + SAME)),
            None => all.into_iter().take(1).collect(),
        }
    }

    /// The input at the line after the first ones that are the same, which a clamp beyond it would make one
    /// with them; infinite where there are none.
    fn next(&self, axis: usize, reading: &AxisReading) -> f64 {
        let (same, all) = (self.same(axis, reading).len(), self.below(axis, reading, f64::INFINITY));
        let next = all.get(same).filter(|_| same > 1);
        next.map_or(f64::INFINITY, |line| self.sample.nodes(axis, reading)[*line])
    }

    /// The input at the last of the first lines that are the same, though their truths differ by more than
    /// formats do; 0 where there are none.
    fn copied(&self, axis: usize, reading: &AxisReading) -> f64 {
        let nodes = self.sample.nodes(axis, reading);
        let same = self.same(axis, reading);
        let largest: Norm = |all| all.fold(0.0, |most, difference| most.max(difference.abs()));
        let is_plain = same.len() < 2 || self.difference(&self.truth, axis, &same, largest) < APART;
        if is_plain { 0.0 } else { same.iter().map(|k| nodes[*k]).fold(0.0, f64::max) }
    }

    /// Whether it makes nothing one that could differ: a line alone, and that not far below the floor, both
    /// taken from the `least` that an input can be.
    fn is_near(&self, axis: usize, reading: &AxisReading, [least, floor]: [f64; 2]) -> bool {
        let near = |line: usize| self.sample.nodes(axis, reading)[line] - least > FAR_BELOW * (floor - least);
        matches!(self.below(axis, reading, floor)[..], [one] if near(one))
    }

    /// What an input was clamped to by the look of it: where the first lines are the same, the last of
    /// them, or between that and the next.
    fn held(&self, axis: usize, reading: &AxisReading) -> Vec<f64> {
        let nodes = self.sample.nodes(axis, reading);
        let lines = self.below(axis, reading, f64::INFINITY);
        let is_same =
            |n: &usize| self.difference(&self.sample.values, axis, &lines[..*n], |all| rms(all)) < SAME;
        let Some(same) = (2..lines.len()).take_while(is_same).last() else { return Vec::new() };
        eighths([nodes[lines[same - 1]], nodes[lines[same]]])
    }

    /// What an input may have been clamped to by a floor that makes several lines one but for noise, which
    /// has no sign: between the last of them and the next.
    fn about(&self, axis: usize, reading: &AxisReading, floor: f64) -> Vec<f64> {
        let nodes = self.sample.nodes(axis, reading);
        let (lines, all) = (self.below(axis, reading, floor), self.below(axis, reading, f64::INFINITY));
        let [mean, rms]: [Norm; 2] = [|all| mean(all).abs(), |all| rms(all)];
        let by = |norm| self.difference(&self.sample.values, axis, &lines, norm);
        match (&lines[..], all.get(lines.len())) {
            ([_, .., last], Some(next)) if by(mean) < NO_SIGN * by(rms) => {
                eighths([nodes[*last], nodes[*next]])
            }
            _ => Vec::new(),
        }
    }
}

/// The mean of some differences; 0 of none.
fn mean(all: &mut dyn Iterator<Item = f64>) -> f64 {
    let (count, sum) = all.fold((0, 0.0), |(count, sum), x| (count + 1, sum + x));
    sum / f64::from(count.max(1))
}

/// A value, and the seven evenly between it and the next.
fn eighths([last, next]: [f64; 2]) -> Vec<f64> {
    (0..8).map(|k| last + (next - last) * f64::from(k) / 8.0).collect()
}

/// Whether a number has two digits at most.
fn is_round(x: f64) -> bool {
    let rounded: f64 = format!("{x:.1e}").parse().unwrap_or(f64::NAN);
    (x - rounded).abs() <= SAME * x
}

/// Times that the clamps of two axes are looked for again beside each other.
const AGAIN: usize = 3;

/// A clamp of the list, or of one digit, is taken for one that is within this share of it, and leaves this
/// share of its rank.
const ROUND: f64 = 0.05;
const WORTH: f64 = 0.8;

/// Share of a clamp to which it is looked for between two lines.
const NARROW: f64 = 1e-4;

/// Share of the root mean square of differences below which their mean is that of noise.
const NO_SIGN: f64 = 0.5;

/// Share of the way from a line to the next within which a clamp stands at that line.
const AT_A_LINE: f64 = 5e-3;

/// Largest error over the root mean square of a table that is off in a corner.
const SPIKED: f64 = 8.0;

/// Share of the largest error that is left where it was one of a clamp.
const MENDED: f64 = 0.05;

/// The same of one line near to the floor, while the clamp of the other input is off by a little.
const NEARLY: f64 = 0.3;

/// Whether a clamp explains something: more of the texels as well as those before, or none fewer
/// clearly better and the worst no worse. A clamp that takes texels out of the domain explains nothing.
fn explains(clamped: &Candidate, before: &Candidate) -> bool {
    let (now, then) = (&clamped.fitted, &before.fitted);
    let worse = largest(now) > 1.5 * largest(then);
    // What mends a single texel and leaves much of its error mends it by chance.
    let worse = worse || rest(now) > 0.9 * rest(then) && largest(now) > 0.2 * largest(then);
    // A corner where the truth jumps, of a table that is rounded everywhere.
    now.texels >= then.texels && now.rank <= then.rank && is_mended(clamped, before, MENDED)
        || now.texels > then.texels && now.rank < 1.2 * then.rank
        || now.texels >= then.texels && now.rank < 0.9 * then.rank && !worse
}

/// The largest error.
fn largest(fitted: &Fitted) -> f64 {
    fitted.misfits.iter().flatten().map(|m| m.max).fold(0.0, f64::max)
}

/// The sum of squares but for the largest error.
fn rest(fitted: &Fitted) -> f64 {
    let of = |m: &Misfit| (m.rms * m.rms * fitted.texels as f64 - m.max * m.max).max(0.0);
    fitted.misfits.iter().flatten().map(of).fold(0.0, f64::max)
}

/// Whether no more than a share of the largest error is left.
fn is_mended(clamped: &Candidate, before: &Candidate, share: f64) -> bool {
    largest(&clamped.fitted) < share * largest(&before.fitted)
}

/// Whether few texels hold most of the error.
fn is_spiked(fitted: &Fitted) -> bool {
    fitted.misfits.iter().flatten().any(|m| m.max > SPIKED * m.rms)
}
