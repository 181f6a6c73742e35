//! The cheap sieve: every convention on a few texels, or, where three axes make too many, each axis in turn.

use rayon::prelude::*;

use super::axis::{AxisReading, Siting};
use super::convention::Pins;
use super::sample::{Candidate, Sample, View, fit_columns, judged, steps};
use super::truth::Truth;

/// Conventions that a sieve lets through.
const KEPT: usize = 300;

/// Rounds of trying each axis in turn.
const ROUNDS: usize = 4;

/// The most promising conventions, the best first.
pub(super) fn screen(truth: &dyn Truth, sample: &Sample, pins: &Pins) -> Vec<Candidate> {
    let axes = sample.size.len();
    let mut found = Vec::new();
    for assigned in permutations(axes) {
        let readings: Vec<Vec<AxisReading>> =
            (0..axes).map(|k| pins.readings(assigned[k], truth.inputs()[k])).collect();
        if readings.iter().any(Vec::is_empty) {
            continue;
        }
        for lobe in pins.lobes(truth) {
            let task = Task { truth, sample, pins, assigned: &assigned, lobe };
            found.extend(if axes < 3 { task.product(&readings) } else { task.alternate(&readings) });
            found = best(found, KEPT);
        }
    }
    found
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
    truth: &'a dyn Truth,
    sample: &'a Sample,
    pins: &'a Pins,
    /// Axis along which each input of the truth runs.
    assigned: &'a [usize],
    lobe: usize,
}

impl Task<'_> {
    /// Every combination of readings, from one tensor of truths over the nodes of all of them.
    fn product(&self, readings: &[Vec<AxisReading>]) -> Vec<Candidate> {
        let dims = self.sample.dims();
        let nodes: Vec<Vec<f64>> = readings
            .iter()
            .zip(self.assigned)
            .map(|(list, axis)| list.iter().flat_map(|r| self.sample.nodes(*axis, r)).collect())
            .collect();
        let at: Vec<&[f64]> = nodes.iter().map(Vec::as_slice).collect();
        let values = self.truth.quick(self.lobe, &at);
        let lengths: Vec<usize> = nodes.iter().map(Vec::len).collect();
        let steps = steps(&lengths, self.assigned);
        let combinations: usize = readings.iter().map(Vec::len).product();
        let one = |index: usize| {
            let (mut rest, mut start) = (index, 0);
            let mut axes = vec![readings[0][0]; self.assigned.len()];
            for (list, axis) in readings.iter().zip(self.assigned) {
                let guess = rest % list.len();
                rest /= list.len();
                start += steps[*axis] * guess * dims[*axis];
                axes[*axis] = list[guess];
            }
            let base = View { values: &values, steps: steps.clone(), start }.gather(&dims);
            let fitted = fit_columns(self.sample, &base, None, self.pins, self.truth.columns())?;
            Some(Candidate { axes, lobe: self.lobe, fitted })
        };
        let all: Vec<Option<Candidate>> = (0..combinations).into_par_iter().map(one).collect();
        best(all.into_iter().flatten().collect(), KEPT)
    }

    /// From several beginnings: the best reading of each axis in turn, until none betters.
    fn alternate(&self, readings: &[Vec<AxisReading>]) -> Vec<Candidate> {
        let starts: Vec<Vec<AxisReading>> = [Siting::Endpoint, Siting::Centre]
            .into_iter()
            .flat_map(|siting| [0, 2].map(|scale| self.start(readings, siting, scale)))
            .collect();
        let found: Vec<Vec<Candidate>> = starts.into_par_iter().map(|s| self.descend(s, readings)).collect();
        let mut distinct: Vec<Candidate> = Vec::new();
        for candidate in best(found.into_iter().flatten().collect(), usize::MAX) {
            if distinct.len() < KEPT / 10 && !distinct.iter().any(|d| d.axes == candidate.axes) {
                distinct.push(candidate);
            }
        }
        distinct
    }

    /// Readings to begin with: a siting where it is allowed, and of the readings with it one of the first.
    fn start(&self, readings: &[Vec<AxisReading>], siting: Siting, scale: usize) -> Vec<AxisReading> {
        let mut axes = vec![readings[0][0]; self.assigned.len()];
        for (list, axis) in readings.iter().zip(self.assigned) {
            let sited: Vec<&AxisReading> = list.iter().filter(|r| r.siting == siting).collect();
            axes[*axis] = sited.get(scale).or(sited.first()).map_or(list[0], |r| **r);
        }
        axes
    }

    fn descend(&self, start: Vec<AxisReading>, readings: &[Vec<AxisReading>]) -> Vec<Candidate> {
        let Some(mut at) = self.quick(start) else { return Vec::new() };
        let mut seen = vec![at.clone()];
        for _ in 0..ROUNDS {
            let before = at.fitted.rank;
            for (list, axis) in readings.iter().zip(self.assigned) {
                for reading in list {
                    let mut axes = at.axes.clone();
                    axes[*axis] = *reading;
                    seen.extend(self.quick(axes));
                }
                seen = best(seen, KEPT / 10);
                at = seen[0].clone();
            }
            if at.fitted.rank >= before {
                break;
            }
        }
        seen
    }

    fn quick(&self, axes: Vec<AxisReading>) -> Option<Candidate> {
        let nodes: Vec<Vec<f64>> =
            self.assigned.iter().map(|axis| self.sample.nodes(*axis, &axes[*axis])).collect();
        let at: Vec<&[f64]> = nodes.iter().map(Vec::as_slice).collect();
        let values = self.truth.quick(self.lobe, &at);
        let lengths: Vec<usize> = nodes.iter().map(Vec::len).collect();
        let view = View { values: &values, steps: steps(&lengths, self.assigned), start: 0 };
        let judged = judged(self.truth, self.sample, &axes);
        // A reading under which most of the table has no truth is no reading.
        if judged.iter().filter(|j| **j).count() * 3 < judged.len() {
            return None;
        }
        let base = view.gather(&self.sample.dims());
        let fitted = fit_columns(self.sample, &base, Some(&judged), self.pins, self.truth.columns())?;
        Some(Candidate { axes, lobe: self.lobe, fitted })
    }
}
