//! What is wrong with a channel, told from the pattern of its errors.

use super::FITS;
use super::block::{About, block};
use super::column::Column;
use super::convention::Fixed;
use super::enlarged::Enlarged;
use super::errors::{Residuals, rms, spread};
use super::extent::Extent;
use super::line::{copies, line};
use super::lobe::Lobe;
use super::spikes::{are_apart, spikes};
use super::table::{AuditedTable, flat, place};
use super::two_lobes::TwoLobes;
use crate::foreign::Step;

/// Something wrong with a channel.
#[derive(Clone, Debug, PartialEq)]
pub enum Defect {
    /// A part of the table is off and the rest is not: stale, or damaged.
    Part {
        /// Texels that are off, and texels judged.
        texels: [usize; 2],
        /// By more than this.
        over: f64,
        /// By this at most.
        most: f64,
        /// At this texel.
        texel: Vec<usize>,
        /// Mean error of those.
        mean: f64,
        /// Root mean square of the errors of all others.
        rest: f64,
        /// Where they lie.
        extent: Extent,
    },
    /// A first or last line that was never filled, and is not judged.
    Dead {
        /// Axis, and index along it.
        line: [usize; 2],
        /// What all of its texels hold.
        value: f64,
    },
    /// A part is off so that what is looked up between its texels is less so.
    Optimised {
        /// Texels that are off.
        texels: usize,
        /// The largest error of a lookup at even places, and with texels that are true.
        lookups: [f64; 2],
    },
    /// More light comes back than came in.
    Gain {
        /// What it is of: a column, or the one that two are halves of.
        column: Column,
        /// The largest albedo.
        albedo: f64,
        /// That texel.
        texel: Vec<usize>,
    },
    /// A part of the table is of the other shadowing form.
    OtherLobe(TwoLobes),
    /// It is a smaller table made larger.
    Enlarged(Enlarged),
    /// All values are so many times what they should be.
    Factor {
        /// So many times.
        factor: f64,
        /// What they should be.
        column: Column,
        /// By this they are off at most.
        most: f64,
        /// At this texel.
        texel: Vec<usize>,
    },
    /// All values stand the other way round.
    Flipped {
        /// Along these axes.
        axes: Vec<usize>,
        /// What they are of.
        column: Column,
        /// By this they are off at most.
        most: f64,
        /// At this texel.
        texel: Vec<usize>,
    },
    /// All values are of another shadowing form than those of the channels beside it.
    ChannelLobe {
        /// Of this one.
        lobe: Lobe,
        /// What they are of.
        column: Column,
        /// By this they are off at most from the form of the others.
        most: f64,
        /// At this texel.
        texel: Vec<usize>,
    },
    /// All values are too high or too low.
    Bias {
        /// Mean error.
        mean: f64,
    },
    /// Values stand at an end of the format where the truth lies beyond.
    Clamped {
        /// The value.
        value: f64,
        /// Texels that stand there and should not.
        texels: usize,
        /// The truth farthest beyond.
        truth: f64,
        /// That texel.
        texel: Vec<usize>,
    },
    /// Errors that jump from texel to texel.
    Noise {
        /// Their root mean square.
        rms: f64,
        /// Share of the whole error's root mean square.
        share: f64,
        /// The format of which they come, where rounding to it makes as much.
        step: Option<Step>,
        /// Whether they are those of the texels beside a part.
        apart: bool,
    },
    /// The errors are what rounding to the format leaves.
    Steps {
        /// The format.
        step: Step,
        /// Root mean square of the error that rounding to it makes.
        rms: f64,
    },
    /// What as many samples as the user states leave at a texel.
    Sampled {
        /// Samples of a texel.
        samples: u32,
        /// The largest error that they leave.
        left: f64,
        /// Texels that are off by more, and texels judged.
        texels: [usize; 2],
    },
    /// A loss that is far too small where the surface is smooth: a sampling that missed the lobe's
    /// tail.
    MissingLoss {
        /// What holds it: of A and B, or R and T, their sum.
        column: Column,
        /// Share of the true loss that a quarter of the smooth texels do not even hold.
        stored: f64,
        /// Largest alpha of those texels.
        alpha: f64,
        /// Where it is worst: stored and true loss.
        worst: [f64; 2],
        /// That texel.
        texel: Vec<usize>,
    },
}

/// A part is reported where errors are this many times the median,
const OFF: f64 = 30.0;
/// above this share of the spread of the truth, a quarter of a step of 8 bits,
pub(super) const SEEN: f64 = 1e-3;
/// make nearly all of the sum of squares,
const PART_OF_SQUARES: f64 = 0.9;
/// are no more than this share of the texels,
const PART_OF_TEXELS: f64 = 0.45;
/// and end at an edge: of errors a third as large there are at most this share as many. Those of a
/// shift, of samples or of an optimiser fade.
const FADING: f64 = 0.1;

/// Steps of a format that a biased quantiser leaves at most: truncation a whole one, which is two of
/// rounding, and a tenth for what it is decoded by.
const BIASED_STEPS: f64 = 2.2;

/// What errors come of without a defect: the format, and the samples that texels are means of, where
/// the user states them.
#[derive(Clone, Copy)]
pub(super) struct Grain {
    pub step: Step,
    /// What values were multiplied by since they were stored.
    pub scale: f64,
    pub samples: Option<u32>,
}

impl Grain {
    /// Of a channel of a table, by its place among all.
    pub(super) fn of(table: &AuditedTable, channel: usize, fixed: &Fixed) -> Grain {
        let step = stored(table.step, &table.channels[channel].values);
        Grain { step, scale: table.scale, samples: fixed.samples }
    }

    /// Root mean square of the error that rounding makes at some values: of half a step over the root of 3.
    pub(super) fn rms(self, values: impl Iterator<Item = f64>) -> f64 {
        rms(values.map(|x| self.rounding(x))) / 3.0_f64.sqrt()
    }

    /// What rounding to the format may have done to a value.
    pub(super) fn rounding(self, x: f64) -> f64 {
        self.scale * self.step.rounding(x / self.scale)
    }

    /// The largest error that these leave at a texel. Samples of visible normals weigh 0 to 1, so that
    /// their standard deviation is at most 1/2 (Popoviciu's inequality): four standard errors of the mean
    /// of n are 2/sqrt(n), of what the column is made of.
    pub(super) fn leaves(self, r: &Residuals, i: usize) -> f64 {
        let sampled = |n: u32| 2.0 / f64::from(n).sqrt() * r.column.slope(r.judgement.base[i]);
        BIASED_STEPS * self.rounding(r.values[i]) + self.samples.map_or(0.0, sampled)
    }
}

/// Largest alpha of texels on which the loss is compared.
const SMOOTH: f64 = 0.12;

/// Rounding explains errors up to this many times its own.
const ROUNDED: f64 = 1.5;

/// Second differences of errors that are rounded show up to this many times the root mean square of rounding.
const NOISE_OF_ROUNDING: f64 = 1.2;

/// Defects of a channel, which may have one that others have not; `alpha` of a texel where the table has such
/// an axis.
pub(super) fn defects(
    r: &Residuals,
    grain: Grain,
    alone: Option<Defect>,
    alpha: impl Fn(&[usize]) -> Option<f64>,
) -> Vec<Defect> {
    let step = grain.step;
    let is_alone = alone.is_some();
    let other = || clamped(r).into_iter().chain(missing_loss(r, grain, 1.0, alpha));
    let mut found: Vec<Defect> = alone.map_or_else(|| other().collect(), |alone| vec![alone]);
    if found.is_empty() {
        let spikes = || spikes(r, grain).map(|spikes| spikes.part(r));
        found.extend(
            copies(r, grain)
                .or_else(|| part(r, grain))
                .or_else(|| edge(r, grain))
                .or_else(|| block(r))
                .or_else(spikes)
                .or_else(|| line(r, grain)),
        );
    }
    let part =
        found.iter().find_map(|d| if let Defect::Part { extent, .. } = d { Some(extent) } else { None });
    let outside = |i: &usize| part.is_none_or(|extent| !r.lies_in(*i, extent));
    let rest: Vec<usize> = r.judged.iter().copied().filter(outside).collect();
    let apart = part.is_some();
    let (noise, rms, rounding) = (noise(r, &rest), r.rms(&rest), rounding(r, &rest, grain));
    if !apart && rms <= ROUNDED * rounding && rest.iter().all(|i| within_a_step(r, grain, *i)) {
        found.push(Defect::Steps { step, rms: rounding });
    } else if noise > 0.5 * rms && rms > 1e-7 {
        let step = is_of_rounding(noise, r, &rest, grain).then_some(step);
        found.push(Defect::Noise { rms: noise, share: noise / rms, step, apart });
    }
    if let Some(samples) = grain.samples {
        let over = r.judged.iter().filter(|i| r.errors[**i].abs() > grain.leaves(r, **i)).count();
        let left = r.judged.iter().map(|i| grain.leaves(r, *i)).fold(0.0, f64::max);
        found.push(Defect::Sampled { samples, left, texels: [over, r.judged.len()] });
    }
    found.extend(bias(r, rms).filter(|_| !apart && !is_alone));
    found
}

/// Root mean square of the errors beside what the truth spans, without what defects in the nature of formats,
/// samples and optimised tables explain.
pub(super) fn left(r: &Residuals, found: &[Defect]) -> f64 {
    let misfit = r.misfit(&r.judged);
    let own = r.rms(&r.judged);
    if own == 0.0 || found.iter().any(|d| matches!(d, Defect::Steps { .. } | Defect::Optimised { .. })) {
        return 0.0;
    }
    let explained = |d: &Defect| match d {
        Defect::Noise { rms, .. } => *rms,
        // What samples leave at most is four standard errors.
        Defect::Sampled { left, .. } => left / 4.0,
        _ => 0.0,
    };
    let explained = found.iter().map(explained).fold(0.0, f64::max);
    without(own, explained) / own * misfit
}

/// The lines of a channel that were never filled.
pub(super) fn dead<'a>(table: &'a AuditedTable, values: &'a [f64]) -> impl Iterator<Item = Defect> + 'a {
    let lines =
        table.dead.iter().enumerate().flat_map(|(axis, ends)| ends.iter().map(move |end| [axis, *end]));
    lines.map(|line| {
        let mut texel = vec![0; table.size.len()];
        texel[line[0]] = line[1];
        Defect::Dead { line, value: values[flat(&texel, &table.size)] }
    })
}

/// Defects of a function: values that stand at a clamp, and a bias.
pub(super) fn of_function(r: &Residuals) -> Vec<Defect> {
    clamped(r).into_iter().chain(bias(r, r.rms(&r.judged))).collect()
}

/// Whether errors jump from texel to texel as rounding makes them.
pub(super) fn is_of_rounding(noise: f64, r: &Residuals, texels: &[usize], grain: Grain) -> bool {
    noise <= NOISE_OF_ROUNDING * rounding(r, texels, grain)
}

/// Root mean square of the error that rounding makes at some texels.
fn rounding(r: &Residuals, texels: &[usize], grain: Grain) -> f64 {
    grain.rms(texels.iter().map(|i| r.values[*i]))
}

/// A root mean square without that of an error which is independent of the rest.
pub(super) fn without(own: f64, part: f64) -> f64 {
    (own * own - part * part).max(0.0).sqrt()
}

/// Whether rounding to nearest explains the error of a texel, but for a tenth of a step and for what
/// the truth is off by.
fn within_a_step(r: &Residuals, grain: Grain, i: usize) -> bool {
    r.errors[i].abs() <= 1.2 * grain.rounding(r.values[i]) + 1e-7
}

fn part(r: &Residuals, grain: Grain) -> Option<Defect> {
    let over = (OFF * r.median()).max(SEEN * r.spread());
    let beyond = |i: &usize, share: f64| r.errors[*i].abs() > share * over.max(grain.leaves(r, *i));
    let off: Vec<usize> = r.judged.iter().copied().filter(|i| beyond(i, 1.0)).collect();
    let squares = |list: &[usize]| list.iter().map(|i| r.errors[*i] * r.errors[*i]).sum::<f64>();
    let small = off.is_empty() || off.len() as f64 > PART_OF_TEXELS * r.judged.len() as f64;
    if small || squares(&off) < PART_OF_SQUARES * squares(&r.judged) {
        return None;
    }
    let extent = Extent::of(r.sample, &off);
    let inside = |i: &usize| !extent.is_whole() && r.lies_in(*i, &extent);
    let fading = r.judged.iter().filter(|i| !beyond(i, 1.0) && beyond(i, 1.0 / 3.0) && !inside(i)).count();
    // Errors of both signs that fade at an edge are those of samples.
    let about = About::of(r, &tight(r, &off).range);
    let ends = about.is_of_one_sign() || about.ends_at_edges();
    (ends && fading as f64 <= FADING * off.len() as f64).then(|| these(r, &off, over))
}

/// A first or last row, column or slice without which the rest fits: a clamp, or an end that was never
/// filled.
fn edge(r: &Residuals, grain: Grain) -> Option<Defect> {
    let dims = r.sample.dims();
    let fits = |list: &[usize]| r.misfit(list) <= FITS;
    if dims.contains(&1) || fits(&r.judged) {
        return None;
    }
    let ends = (0..dims.len()).flat_map(|axis| [(axis, 0), (axis, dims[axis] - 1)]);
    ends.into_iter().find_map(|(axis, end)| {
        let (line, rest): (Vec<usize>, Vec<usize>) =
            r.judged.iter().partition(|i| place(**i, &dims)[axis] == end);
        let over = rest.iter().map(|i| r.errors[*i].abs()).fold(0.0, f64::max);
        let beyond = |i: &usize| r.errors[*i].abs() > over.max(grain.leaves(r, *i));
        let off: Vec<usize> = line.into_iter().filter(beyond).collect();
        (!off.is_empty() && !rest.is_empty() && fits(&rest)).then(|| these(r, &off, over))
    })
}

/// The part of these texels, which are off by more than `over`, but for those far from the others.
fn these(r: &Residuals, off: &[usize], over: f64) -> Defect {
    of_extent(r, tight(r, off), off, over)
}

/// The part of those of these texels that lie in an extent.
pub(super) fn of_extent(r: &Residuals, extent: Extent, off: &[usize], over: f64) -> Defect {
    let inside: Vec<usize> = off.iter().filter(|i| r.lies_in(**i, &extent)).copied().collect();
    // A range leaves out strays: lines of either axis may cross where none of the texels is.
    let off = if inside.is_empty() { off } else { &inside };
    let singles = || Extent::singles(extent.size.clone(), off.iter().map(|i| r.texel(*i)));
    let extent = if are_apart(r, off) { singles() } else { extent };
    let mut is_off = vec![false; r.values.len()];
    off.iter().for_each(|i| is_off[*i] = true);
    let others: Vec<usize> = r.judged.iter().filter(|i| !is_off[**i]).copied().collect();
    let mean = off.iter().map(|i| r.errors[*i]).sum::<f64>() / off.len() as f64;
    let worst = off.iter().fold(off[0], |w, i| if r.errors[*i].abs() > r.errors[w].abs() { *i } else { w });
    let (most, texel) = (r.errors[worst].abs(), r.texel(worst));
    let (texels, rest) = ([off.len(), r.judged.len()], r.rms(&others));
    Defect::Part { texels, over, most, texel, mean, rest, extent }
}

/// Lines at an end of a part are left out of it while their squares are less than this share of those
/// of its worst line: samples and optimisers leave a few texels over the bound far from a damage.
const STRAY: f64 = 0.04;

/// First and last index along every axis of the lines that texels stand out on.
pub(super) fn tight(r: &Residuals, texels: &[usize]) -> Extent {
    let all = Extent::of(r.sample, texels);
    let along = |(axis, range): (usize, &[usize; 2])| {
        let mut squares = vec![0.0; r.sample.size[axis]];
        for i in texels {
            squares[r.texel(*i)[axis]] += r.errors[*i] * r.errors[*i];
        }
        let least = STRAY * squares.iter().fold(0.0, |m: f64, x| m.max(*x));
        let line = |k: &usize| squares[*k] >= least;
        let lines = range[0]..=range[1];
        [lines.clone().find(line).unwrap_or(range[0]), lines.rev().find(line).unwrap_or(range[1])]
    };
    Extent { range: all.range.iter().enumerate().map(along).collect(), ..all }
}

fn clamped(r: &Residuals) -> Option<Defect> {
    let ends = [r.judged.iter().map(|i| r.values[*i]).fold(f64::NEG_INFINITY, f64::max), 0.0];
    let least = (10.0 * r.median()).max(1e-3);
    let repeated = repeated_lines(r);
    let mut told = None;
    for (end, upper) in ends.into_iter().zip([true, false]) {
        let beyond = |i: &&usize| {
            let past = if upper { r.truth(**i) - end } else { end - r.truth(**i) };
            r.values[**i] == end && past > least
        };
        // Lines that a clamp of an input makes one hold one value: the first of them is looked at.
        let is_first = |i: &usize| !r.sample.lies_on(*i, &repeated);
        let stuck: Vec<usize> = r.judged.iter().filter(beyond).copied().filter(is_first).collect();
        if stuck.len() >= 2 && spread(stuck.iter().map(|i| r.truth(*i))) > 0.0 {
            let far = |a: &&usize, b: &&usize| r.errors[**a].abs().total_cmp(&r.errors[**b].abs());
            let worst = stuck.iter().max_by(far).copied().unwrap_or(stuck[0]);
            let (texels, truth) = (stuck.len(), r.truth(worst));
            told = Some(Defect::Clamped { value: end, texels, truth, texel: r.texel(worst) });
        }
    }
    told
}

/// Values of lines are the same that differ by no more than this share of them: rounding of singles.
const ALIKE: f64 = 1e-6;

/// Which lines along every axis are the same as the one before them; nothing of one axis, whose lines are
/// its texels.
pub(super) fn repeated_lines(r: &Residuals) -> Vec<Vec<bool>> {
    if r.sample.at.len() > 1 { r.sample.repeated(&[r.values], ALIKE) } else { Vec::new() }
}

/// Root mean square of white noise that would make the second differences of the errors among some texels,
/// along the axis where they are least.
pub(super) fn noise(r: &Residuals, texels: &[usize]) -> f64 {
    let dims = r.sample.dims();
    let mut among = vec![false; r.values.len()];
    texels.iter().for_each(|i| among[*i] = true);
    let along = |axis: usize| {
        let mut squares = Vec::new();
        for i in texels {
            let mut at = place(*i, &dims);
            if at[axis] == 0 || at[axis] + 1 == dims[axis] {
                continue;
            }
            at[axis] -= 1;
            let before = flat(&at, &dims);
            at[axis] += 2;
            let after = flat(&at, &dims);
            if among[before] && among[after] {
                let second = r.errors[before] - 2.0 * r.errors[*i] + r.errors[after];
                squares.push(second * second);
            }
        }
        let n = squares.len().max(1) as f64;
        // Of white noise of variance s^2 a second difference has 6 s^2.
        (squares.iter().sum::<f64>() / (6.0 * n)).sqrt()
    };
    (0..dims.len()).map(along).fold(f64::INFINITY, f64::min)
}

fn bias(r: &Residuals, rms: f64) -> Option<Defect> {
    let mean = r.judged.iter().map(|i| r.errors[*i]).sum::<f64>() / r.judged.len() as f64;
    let told = mean.abs() > 0.6 * rms && mean.abs() > 1e-4 * r.spread();
    told.then_some(Defect::Bias { mean })
}

/// A loss without its tail, of values that a format rounds by so many steps each.
pub(super) fn missing_loss(
    r: &Residuals,
    grain: Grain,
    steps: f64,
    alpha: impl Fn(&[usize]) -> Option<f64>,
) -> Option<Defect> {
    let loss = |value: f64| r.column.albedo(value).map(|e| 1.0 - e);
    let mut shares = Vec::new();
    for i in &r.judged {
        let texel = r.texel(*i);
        let Some(alpha) = alpha(&texel).filter(|a| *a <= SMOOTH) else { continue };
        let (Some(stored), Some(truth)) = (loss(r.values[*i]), loss(r.truth(*i))) else { continue };
        // Below a few steps the format cannot hold a loss, nor do few samples come by it.
        let rare = grain.samples.map_or(0.0, |n| 16.0 / f64::from(n));
        if truth > (8.0 * steps * grain.rounding(r.values[*i])).max(rare).max(3e-4) {
            shares.push((stored / truth, alpha, [stored, truth], texel));
        }
    }
    let mut stored: Vec<f64> = shares.iter().map(|s| s.0).collect();
    stored.sort_by(f64::total_cmp);
    let [quarter, upper] =
        [1, 3].map(|quarters| stored.get(quarters * stored.len() / 4).copied().unwrap_or(1.0));
    // What is off the other way by as much misses no tail, nor does what is too much as often.
    let is_noise = upper - 1.0 > 0.5 * (1.0 - quarter);
    if shares.len() < 8 || !(-1.0..=0.7).contains(&quarter) || is_noise {
        return None;
    }
    let alpha = shares.iter().map(|s| s.1).fold(0.0, f64::max);
    let worst = shares.into_iter().max_by(|a, b| (a.2[1] - a.2[0]).total_cmp(&(b.2[1] - b.2[0])))?;
    Some(Defect::MissingLoss { column: r.column, stored: quarter, alpha, worst: worst.2, texel: worst.3 })
}

/// Bits of a channel of the formats that pictures of 8 bits are made of: 4444, 565.
const FEW_BITS: [u32; 3] = [4, 5, 6];

/// What the values of a channel are rounded to: the file's word, or for a file that can hold more
/// than was put into it the coarsest format that all values fit.
pub(super) fn stored(step: Step, values: &[f64]) -> Step {
    let few = |bits: &u32| {
        let most = f64::from((1_u32 << bits) - 1);
        // Within half a step of 8 bits. A constant tells no steps.
        values.iter().any(|v| *v != values[0])
            && values.iter().all(|v| (v * most - (v * most).round()).abs() <= most * 0.51 / 255.0)
    };
    if let Step::Small(bits @ 6..=10) = step {
        // Of a word of 32 bits the last float has a bit less.
        let ends = |v: &f64| half::f16::from_f64(*v).to_bits().is_multiple_of(1 << (11 - bits));
        return if values.iter().all(ends) { Step::Small(bits - 1) } else { step };
    }
    if step != Step::None || values.len() < 16 {
        let coarse = FEW_BITS.iter().find(|bits| step == Step::Unorm(8) && values.len() >= 16 && few(bits));
        return coarse.map_or(step, |bits| Step::Unorm(*bits));
    }
    let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    // A single holds a multiple of 1/n to 6e-8 of itself.
    let is_multiple = |v: f64, n: f64| (v * n - (v * n).round()).abs() < (1.2e-7 * n * largest).min(0.15);
    // A format with its steps from 0 to 1; halves have steps of many lengths.
    let formats = [
        (Step::Unorm(8), Some(255.0)),
        (Step::Decimals(3), Some(1e3)),
        (Step::Unorm(10), Some(1023.0)),
        (Step::Half, None),
        (Step::Decimals(4), Some(1e4)),
        (Step::Unorm(16), Some(65535.0)),
        (Step::Decimals(5), Some(1e5)),
        (Step::Decimals(6), Some(1e6)),
    ];
    let holds = |v: f64, n| match n {
        Some(n) => is_multiple(v, n),
        None => half::f16::from_f64(v).to_f64() == v,
    };
    let fits = |(_, n): &(Step, Option<f64>)| values.iter().all(|v| holds(*v, *n));
    formats.into_iter().find(fits).map_or(Step::None, |(format, _)| format)
}
