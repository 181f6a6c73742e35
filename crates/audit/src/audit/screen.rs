//! The cheap sieve: every convention on a few texels; where three axes make too many, first with
//! the two usual registrations, which lie half a texel from all others, then the coordinates that
//! fit best with every registration.

use rayon::prelude::*;

use super::AuditError;
use super::axis::{AxisReading, Input, Registration, Scale};
use super::convention::Fixed;
use super::sample::{Candidate, Sample, View, everywhere, fit_columns, judged_along, ranked, shared, steps};
use super::truth::Truth;

/// Conventions that a sieve lets through.
const KEPT: usize = 300;

/// Choices of coordinates, of three axes, that are tried with every registration: of each order of
/// axes and lobe, and the best of all of those together. Where the texels lie shifts an axis by
/// half a texel, which on a short axis is as much as another power of its coordinate is, so that
/// with the usual registrations the right powers may come late.
const COORDINATES: usize = 6;
const COORDINATES_OF_ALL: usize = 120;

/// The most promising conventions of some lobes, the best first. Of three axes, and of the shadowings
/// of others, first the coordinates are chosen and then the registrations.
pub(super) fn screen(
    truth: &Truth,
    sample: &Sample,
    fixed: &Fixed,
    lobes: &[usize],
) -> Result<Vec<Candidate>, AuditError> {
    let axes = sample.size.len();
    let at_once = axes < 3 && lobes.iter().all(|lobe| truth.lobes()[*lobe].form.integrand.is_none());
    let (mut found, mut rough) = (Vec::new(), Vec::new());
    for assigned in permutations(axes) {
        let readings: Vec<Vec<AxisReading>> =
            (0..axes).map(|k| fixed.readings(assigned[k], truth.inputs()[k])).collect();
        for lobe in lobes {
            let both = truth.lobes()[*lobe].both;
            let suits =
                |r: &&AxisReading| r.scale.input() != Input::Ior || r.scale.is_of_both_sides() == both;
            let of_side = |list: &Vec<AxisReading>| list.iter().filter(suits).copied().collect();
            let readings: Vec<Vec<AxisReading>> = readings.iter().map(of_side).collect();
            if readings.iter().any(Vec::is_empty) {
                continue;
            }
            let task = Task { truth, sample, fixed, assigned: &assigned, lobe: *lobe };
            if at_once {
                found = best([found, task.product(&readings)?].concat(), KEPT);
            } else {
                rough.push(task.coordinates(&readings)?);
            }
        }
    }
    if at_once { Ok(found) } else { sited(truth, sample, fixed, rough) }
}

/// The best choices of coordinates with every registration: `rough` has those of each order of axes
/// and lobe, the best first.
fn sited(
    truth: &Truth,
    sample: &Sample,
    fixed: &Fixed,
    rough: Vec<Vec<Candidate>>,
) -> Result<Vec<Candidate>, AuditError> {
    let of_group = |list: Vec<Candidate>| list.into_iter().enumerate();
    let mut all: Vec<(usize, Candidate)> = rough.into_iter().flat_map(of_group).collect();
    all.sort_by(|a, b| a.1.fitted.rank.total_cmp(&b.1.fitted.rank));
    let chosen = all.into_iter().enumerate();
    let chosen =
        chosen.filter(|(i, (k, _))| *i < COORDINATES_OF_ALL || *k < COORDINATES).map(|(_, (_, c))| c);
    let mut found = Vec::new();
    for Candidate { axes, lobe, .. } in chosen {
        let along = |input: &Input| axes.iter().position(|a| a.scale.input() == *input).unwrap_or(0);
        let assigned: Vec<usize> = truth.inputs().iter().map(along).collect();
        let readings = |(axis, input): (&usize, &Input)| -> Vec<AxisReading> {
            let own = (axes[*axis].scale, axes[*axis].reversed);
            let all = fixed.readings(*axis, *input);
            all.into_iter().filter(|r| (r.scale, r.reversed) == own).collect()
        };
        let readings: Vec<Vec<AxisReading>> = assigned.iter().zip(truth.inputs()).map(readings).collect();
        let task = Task { truth, sample, fixed, assigned: &assigned, lobe };
        found = best([found, best(task.product(&readings)?, KEPT / 10)].concat(), KEPT);
    }
    Ok(found)
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
    /// Every combination of readings, from one tensor of truths over the nodes of all of them.
    fn product(&self, readings: &[Vec<AxisReading>]) -> Result<Vec<Candidate>, AuditError> {
        let dims = self.sample.dims();
        let nodes: Vec<Vec<f64>> = readings
            .iter()
            .zip(self.assigned)
            .map(|(list, axis)| list.iter().flat_map(|r| self.sample.nodes(*axis, r)).collect())
            .collect();
        let at: Vec<&[f64]> = nodes.iter().map(Vec::as_slice).collect();
        let values = self.truth.quick(self.lobe, &at)?;
        let lengths: Vec<usize> = nodes.iter().map(Vec::len).collect();
        let steps = steps(&lengths, self.assigned);
        let combinations: usize = readings.iter().map(Vec::len).product();
        let shared = shared(self.truth, self.sample, self.fixed, self.lobe);
        // Which places are judged under each reading, by input.
        let along = |(list, axis): (&Vec<AxisReading>, &usize)| -> Vec<Vec<bool>> {
            list.iter().map(|r| judged_along(self.truth, self.sample, (*axis, r), self.lobe)).collect()
        };
        let flags: Vec<Vec<Vec<bool>>> = readings.iter().zip(self.assigned).map(along).collect();
        let one = |index: usize| {
            let (mut rest, mut start) = (index, 0);
            let mut axes = vec![readings[0][0]; self.assigned.len()];
            let mut own: Vec<&[bool]> = vec![&[]; self.assigned.len()];
            for (input, axis) in self.assigned.iter().enumerate() {
                let guess = rest % readings[input].len();
                rest /= readings[input].len();
                start += steps[*axis] * guess * dims[*axis];
                axes[*axis] = readings[input][guess];
                own[*axis] = &flags[input][guess];
            }
            let judged = ranked(everywhere(own.into_iter()), shared.as_ref());
            let base = View { values: &values, steps: steps.clone(), start }.gather(&dims);
            let fitted = fit_columns(self.sample, &base, Some(&judged), self.fixed, self.truth.columns())?;
            Some(Candidate { axes, lobe: self.lobe, fitted })
        };
        let all: Vec<Option<Candidate>> = (0..combinations).into_par_iter().map(one).collect();
        Ok(best(all.into_iter().flatten().collect(), KEPT))
    }

    /// The choices of coordinates, each with the usual registrations that suit it best; the best
    /// first.
    fn coordinates(&self, readings: &[Vec<AxisReading>]) -> Result<Vec<Candidate>, AuditError> {
        let usual = |list: &Vec<AxisReading>| -> Vec<AxisReading> {
            let two = list
                .iter()
                .filter(|r| matches!(r.registration, Registration::Centre | Registration::Endpoint));
            let two: Vec<AxisReading> = two.copied().collect();
            if two.is_empty() { list.clone() } else { two }
        };
        let own =
            |c: &Candidate| c.axes.iter().map(|a| (a.scale, a.reversed)).collect::<Vec<(Scale, bool)>>();
        let mut chosen: Vec<Candidate> = Vec::new();
        for candidate in self.product(&readings.iter().map(usual).collect::<Vec<_>>())? {
            if chosen.len() < COORDINATES_OF_ALL && chosen.iter().all(|c| own(c) != own(&candidate)) {
                chosen.push(candidate);
            }
        }
        Ok(chosen)
    }
}
