//! The cheap sieve: every convention on a few texels; where three axes make too many, first with
//! the two usual registrations, which lie half a texel from all others, then the coordinates that
//! fit best with every registration. All are judged on some thirty of the few texels first.

use rayon::prelude::*;

use super::axis::{AxisReading, Input, Registration, Scale};
use super::convention::Fixed;
use super::errors::Residuals;
use super::judge::Judgement;
use super::sample::{
    Candidate, Sample, Tensor, assigned, every, everywhere, fit_columns, judged, judged_along, offsets,
    ranked, shared,
};
use super::truth::{Truth, Values};
use super::{AuditError, FITS};

/// Conventions that a sieve lets through.
const KEPT: usize = 300;

/// Choices of coordinates, of three axes, that are tried with every registration: of each order of
/// axes and lobe, and the best of all of those together. Where the texels lie shifts an axis by
/// half a texel, which on a short axis is as much as another power of its coordinate is, so that
/// with the usual registrations the right powers may come late.
const COORDINATES: usize = 6;
const COORDINATES_OF_ALL: usize = 120;

/// Of conventions tried at once all are judged on some [`FIRST`] texels first, which lie across all
/// lines of the sample, and these many at least, or one in [`THINNED`] of them, on all.
const MANY: usize = 128;
const THINNED: usize = 8;
const FIRST: usize = 30;

/// Root mean square beside the spread of the truth, on the few texels of a sieve, above which a channel
/// follows nothing: four times what fits.
pub(super) const PROMISING: f64 = 4.0 * FITS;

/// What a sieve lets through.
#[derive(Clone)]
pub(super) struct Sieved {
    /// The most promising conventions of all channels together, the best first.
    pub list: Vec<Candidate>,
    /// Of each channel alone the least misfit under any convention.
    misfits: Vec<f64>,
}

impl Sieved {
    /// Whether a channel, by its place, may follow a convention on its own.
    pub fn is_promising(&self, channel: usize) -> bool {
        self.misfits[channel] <= PROMISING
    }

    /// Whether all may.
    pub fn all_promising(&self) -> bool {
        (0..self.misfits.len()).all(|k| self.is_promising(k))
    }

    /// What is ranked by: the first rank, or infinity.
    pub fn rank(&self) -> f64 {
        self.list.first().map_or(f64::INFINITY, |c| c.fitted.rank)
    }

    /// The sieved conventions of two sets of lobes, of which the first is gone on with.
    pub fn beside(self, other: &Sieved) -> Sieved {
        let least = self.misfits.iter().zip(&other.misfits).map(|(a, b)| a.min(*b));
        Sieved { misfits: least.collect(), list: self.list }
    }
}

/// The most promising conventions of some lobes. Of three axes, and of the shadowings of others, first
/// the coordinates are chosen and then the registrations.
pub(super) fn screen(
    truth: &Truth,
    sample: &Sample,
    fixed: &Fixed,
    lobes: &[usize],
) -> Result<Sieved, AuditError> {
    // A channel that nothing is asked of is not far from it.
    let asked = |k: usize| fixed.meanings.as_ref().is_none_or(|given| given[k].is_some());
    let misfits = (0..sample.values.len()).map(|k| if asked(k) { f64::INFINITY } else { 0.0 }).collect();
    let mut sieved = Sieved { list: Vec::new(), misfits };
    let axes = sample.size.len();
    let at_once = axes < 3 && lobes.iter().all(|lobe| truth.lobes[*lobe].form.integrand.is_none());
    let mut rough = Vec::new();
    for assigned in permutations(axes) {
        let readings: Vec<Vec<AxisReading>> =
            (0..axes).map(|k| fixed.readings(assigned[k], truth.spec.inputs[k])).collect();
        for lobe in lobes {
            let both = truth.lobes[*lobe].both;
            let suits =
                |r: &&AxisReading| r.scale.input() != Input::Ior || r.scale.is_of_both_sides() == both;
            let of_side = |list: &Vec<AxisReading>| list.iter().filter(suits).copied().collect();
            let readings: Vec<Vec<AxisReading>> = readings.iter().map(of_side).collect();
            if readings.iter().any(Vec::is_empty) {
                continue;
            }
            let task = Task { truth, sample, fixed, assigned: &assigned, lobe: *lobe };
            if at_once {
                task.product(&readings, KEPT, &mut sieved)?;
            } else {
                rough.push(task.coordinates(&readings, &mut sieved)?);
            }
        }
    }
    if !at_once {
        sited(truth, sample, fixed, rough, &mut sieved)?;
    }
    Ok(sieved)
}

/// The best choices of coordinates with every registration: `rough` has those of each order of axes
/// and lobe, the best first.
fn sited(
    truth: &Truth,
    sample: &Sample,
    fixed: &Fixed,
    rough: Vec<Vec<Candidate>>,
    sieved: &mut Sieved,
) -> Result<(), AuditError> {
    let of_group = |list: Vec<Candidate>| list.into_iter().enumerate();
    let mut all: Vec<(usize, Candidate)> = rough.into_iter().flat_map(of_group).collect();
    all.sort_by(|a, b| a.1.fitted.rank.total_cmp(&b.1.fitted.rank));
    let chosen = all.into_iter().enumerate();
    // No registration makes a channel fit that is twice as far off as a promising one.
    let lost = sieved.misfits.iter().any(|misfit| *misfit > 2.0 * PROMISING);
    let kept = |i: usize, k: usize| i < COORDINATES || !lost && (i < COORDINATES_OF_ALL || k < COORDINATES);
    let chosen = chosen.filter(|(i, (k, _))| kept(*i, *k)).map(|(_, (_, c))| c);
    for Candidate { axes, lobe, .. } in chosen {
        let assigned = assigned(truth, &axes);
        let readings = |(axis, input): (&usize, &Input)| -> Vec<AxisReading> {
            let own = (axes[*axis].scale, axes[*axis].reversed);
            let all = fixed.readings(*axis, *input);
            all.into_iter().filter(|r| (r.scale, r.reversed) == own).collect()
        };
        let readings: Vec<Vec<AxisReading>> = assigned.iter().zip(truth.spec.inputs).map(readings).collect();
        let task = Task { truth, sample, fixed, assigned: &assigned, lobe };
        task.product(&readings, KEPT / 10, sieved)?;
    }
    Ok(())
}

/// The best of a list, by rank; of equals the first stays first.
pub(super) fn best(mut list: Vec<Candidate>, most: usize) -> Vec<Candidate> {
    list.sort_by(|a, b| a.fitted.rank.total_cmp(&b.fitted.rank));
    list.truncate(most);
    list
}

/// Every order of 0..n, n at most 3.
fn permutations(n: usize) -> Vec<Vec<usize>> {
    match n {
        1 => vec![vec![0]],
        2 => vec![vec![0, 1], vec![1, 0]],
        _ => [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]].map(Vec::from).to_vec(),
    }
}

struct Task<'a> {
    truth: &'a Truth<'a>,
    sample: &'a Sample,
    fixed: &'a Fixed,
    /// Axis along which each input of the truth runs.
    assigned: &'a [usize],
    lobe: usize,
}

impl Task<'_> {
    /// Every combination of readings, from one tensor of truths over the nodes of all of them; the best
    /// `most` are added to what was sieved.
    fn product(
        &self,
        readings: &[Vec<AxisReading>],
        most: usize,
        sieved: &mut Sieved,
    ) -> Result<(), AuditError> {
        let dims = self.sample.dims();
        let nodes: Vec<Vec<f64>> = readings
            .iter()
            .zip(self.assigned)
            .map(|(list, axis)| list.iter().flat_map(|r| self.sample.nodes(*axis, r)).collect())
            .collect();
        let tensor = Tensor::new(self.truth, self.lobe, &nodes, self.assigned, Truth::quick)?;
        let offsets = offsets(&every(&dims), &tensor.steps);
        let count = offsets.len();
        let all = All { task: self, readings, tensor, offsets, dims };
        let combinations: Vec<usize> = (0..readings.iter().map(Vec::len).product()).collect();
        let kept = match combinations.len() {
            n if n > MANY => {
                let across = |stride: &usize| count >= FIRST * stride && !all.dims[0].is_multiple_of(*stride);
                let stride = [7, 5, 3].into_iter().find(across).unwrap_or(1);
                let ranked = all.fitted(&combinations, stride);
                best(ranked, (n / THINNED).max(MANY)).into_iter().map(|c| all.index(&c)).collect()
            }
            _ => combinations,
        };
        let fitted = all.fitted(&kept, 1);
        for (channel, least) in sieved.misfits.iter_mut().enumerate() {
            let rank = |c: &&Candidate| c.fitted.misfits[channel].map_or(f64::INFINITY, |m| m.rank());
            let nearest = fitted.iter().min_by(|a, b| rank(a).total_cmp(&rank(b)));
            *least = nearest.map_or(*least, |c| least.min(all.misfit(c, channel)));
        }
        if self.fixed.meanings.is_none() && self.fixed.column.is_some() {
            // One of the channels is the column.
            let least = sieved.misfits.iter().copied().fold(f64::INFINITY, f64::min);
            sieved.misfits.fill(least);
        }
        sieved.list = best([std::mem::take(&mut sieved.list), best(fitted, most)].concat(), KEPT);
        Ok(())
    }

    /// The choices of coordinates, each with the usual registrations that suit it best; the best
    /// first.
    fn coordinates(
        &self,
        readings: &[Vec<AxisReading>],
        sieved: &mut Sieved,
    ) -> Result<Vec<Candidate>, AuditError> {
        let usual = |list: &Vec<AxisReading>| -> Vec<AxisReading> {
            let two = list
                .iter()
                .filter(|r| matches!(r.registration, Registration::Centre | Registration::Endpoint));
            let two: Vec<AxisReading> = two.copied().collect();
            if two.is_empty() { list.clone() } else { two }
        };
        let own =
            |c: &Candidate| c.axes.iter().map(|a| (a.scale, a.reversed)).collect::<Vec<(Scale, bool)>>();
        let mut some = Sieved { list: Vec::new(), misfits: sieved.misfits.clone() };
        self.product(&readings.iter().map(usual).collect::<Vec<_>>(), KEPT, &mut some)?;
        sieved.misfits = some.misfits;
        let mut chosen: Vec<Candidate> = Vec::new();
        for candidate in some.list {
            if chosen.len() < COORDINATES_OF_ALL && chosen.iter().all(|c| own(c) != own(&candidate)) {
                chosen.push(candidate);
            }
        }
        Ok(chosen)
    }
}

/// All combinations of some readings, by a number.
struct All<'a> {
    task: &'a Task<'a>,
    /// By input.
    readings: &'a [Vec<AxisReading>],
    /// Truths at the nodes of all readings.
    tensor: Tensor,
    /// Where the texels of the sample lie in them under the first combination.
    offsets: Vec<usize>,
    dims: Vec<usize>,
}

impl All<'_> {
    /// The number of a reading of all axes.
    fn index(&self, candidate: &Candidate) -> usize {
        let inputs = self.readings.iter().zip(self.task.assigned).rev();
        inputs.fold(0, |index, (list, axis)| {
            let own = list.iter().position(|r| *r == candidate.axes[*axis]).unwrap_or(0);
            index * list.len() + own
        })
    }

    /// The places of the readings of a combination, by input.
    fn guesses(&self, mut index: usize) -> Vec<usize> {
        let one = |list: &Vec<AxisReading>| {
            let guess = index % list.len();
            index /= list.len();
            guess
        };
        self.readings.iter().map(one).collect()
    }

    /// Base values under a combination at every `stride`th texel.
    fn base(&self, guesses: &[usize], stride: usize) -> Values {
        let along = |(guess, axis): (&usize, &usize)| self.tensor.steps[*axis] * guess * self.dims[*axis];
        let start: usize = guesses.iter().zip(self.task.assigned).map(along).sum();
        self.offsets.iter().step_by(stride).map(|offset| self.tensor.values[start + offset]).collect()
    }

    /// Combinations with their figures at every `stride`th texel, in their order.
    fn fitted(&self, combinations: &[usize], stride: usize) -> Vec<Candidate> {
        let Task { truth, sample, fixed, assigned, lobe } = *self.task;
        let values: Vec<Vec<f64>> =
            sample.values.iter().map(|list| list.iter().copied().step_by(stride).collect()).collect();
        let shared = shared(truth, sample, fixed, lobe);
        // Which places are judged under each reading, by input.
        let along = |(list, axis): (&Vec<AxisReading>, &usize)| -> Vec<Vec<bool>> {
            list.iter().map(|r| judged_along(truth, sample, (*axis, r), lobe)).collect()
        };
        let flags: Vec<Vec<Vec<bool>>> = self.readings.iter().zip(assigned).map(along).collect();
        let one = |index: &usize| {
            let guesses = self.guesses(*index);
            let mut axes = vec![self.readings[0][0]; assigned.len()];
            let mut own: Vec<&[bool]> = vec![&[]; assigned.len()];
            for ((input, axis), guess) in assigned.iter().enumerate().zip(&guesses) {
                axes[*axis] = self.readings[input][*guess];
                own[*axis] = &flags[input][*guess];
            }
            let judged = ranked(everywhere(own.into_iter()), shared.as_ref());
            let judged: Vec<bool> = judged.into_iter().step_by(stride).collect();
            let base = self.base(&guesses, stride);
            let fitted = fit_columns((&values, &sample.at_one), &base, &judged, fixed, truth.spec.columns)?;
            Some(Candidate { axes, lobe, fitted })
        };
        combinations.par_iter().filter_map(one).collect()
    }

    /// Root mean square of a channel beside the spread of its truth.
    fn misfit(&self, candidate: &Candidate, channel: usize) -> f64 {
        let Task { truth, sample, lobe, .. } = *self.task;
        let base = self.base(&self.guesses(self.index(candidate)), 1);
        let judgement = Judgement { base, judged: judged(truth, sample, &candidate.axes, lobe) };
        let of = |column| Residuals::new(sample, &judgement, column, &sample.values[channel]).of_all();
        candidate.fitted.columns[channel].map_or(f64::INFINITY, of)
    }
}
