//! The linear program of a step: the largest linearised residual and the violation of linearised
//! constraints, smallest within a box, by the dual simplex over all rows.
//!
//! Variables are z, the excess s where there are constraints, and u, all in units of the radius and
//! from where they stand without a step, so that a small box is as exact as a large one. With
//! t = largest residual: minimise u = t + s / weight, subject to |r + A z| <= t, g + B z >= -s,
//! s >= 0, |z| <= 1; without a norm u = s.

use super::bounds::LinearBounds;
use super::objective::largest;
use crate::simplex::{Rows, minimise_last};

/// Violations below this part of the radius are accepted.
const SLACK: f64 = 1e-11;

/// What a program is made of.
pub(super) struct Minimax<'a> {
    pub residuals: &'a [f64],
    /// A, row by row.
    pub along: &'a [f64],
    /// The constraints and B, row by row.
    pub bounds: Option<(&'a LinearBounds, &'a [f64])>,
    /// Of the norm against violations; 0: only violations count.
    pub weight: f64,
    pub radius: f64,
    /// Number of z.
    pub count: usize,
}

/// Where a program's minimum lies.
pub(super) struct Lowest {
    /// In the units of the residuals.
    pub z: Vec<f64>,
    /// weight * norm + violation there.
    pub bound: f64,
}

/// A row of the program.
#[derive(Clone, Copy, PartialEq)]
enum Id {
    /// r + A z <= t
    Above(usize),
    /// -r - A z <= t
    Below(usize),
    /// g + B z >= -s
    Kept(usize),
    /// g + B z <= s, of an equation.
    Equal(usize),
    /// s >= 0
    Floor,
    /// -z <= 1
    Low(usize),
    /// z <= 1
    High(usize),
}

struct Program<'a> {
    of: &'a Minimax<'a>,
    /// The largest residual without a step.
    top: f64,
    /// The worst violation without a step.
    over: f64,
    /// -1 / weight in the rows of residuals; 0 without constraints.
    share: f64,
}

impl Minimax<'_> {
    /// The minimum; none where rounding leaves the simplex no way on.
    pub fn lowest(&self) -> Option<Lowest> {
        let over = self.bounds.map_or(0.0, |(bounds, _)| bounds.worst(&bounds.values));
        let top = largest(self.residuals);
        let share = if self.bounds.is_some() && self.weight > 0.0 { -1.0 / self.weight } else { 0.0 };
        let mut program = Program { of: self, top, over, share };
        let start = program.start();
        let vertex = minimise_last(&mut program, &[], &start).ok()?;
        let u = vertex.x[vertex.x.len() - 1] * self.radius;
        let z = vertex.x[..self.count].iter().map(|z| z * self.radius).collect();
        let bound = if self.weight > 0.0 { self.weight * (top + u) + over } else { over + u };
        Some(Lowest { z, bound })
    }

    fn normed(&self) -> bool {
        self.weight > 0.0
    }
}

impl Program<'_> {
    fn dot(&self, along: &[f64], i: usize, z: &[f64]) -> f64 {
        along[i * self.of.count..(i + 1) * self.of.count].iter().zip(z).map(|(a, z)| a * z).sum()
    }

    /// The rows of a vertex whose multipliers are not negative: a largest residual, the box where it
    /// falls, and no excess.
    fn start(&self) -> Vec<Id> {
        let k = self.of.count;
        let mut start = Vec::with_capacity(k + 2);
        let peak = (0..self.of.residuals.len())
            .max_by(|&i, &j| self.of.residuals[i].abs().total_cmp(&self.of.residuals[j].abs()));
        let mut slope = vec![0.0; k];
        if let Some(peak) = peak.filter(|_| self.of.normed()) {
            let above = self.of.residuals[peak] > 0.0;
            let sign = if above { 1.0 } else { -1.0 };
            slope.iter_mut().zip(&self.of.along[peak * k..]).for_each(|(s, a)| *s = sign * a);
            start.push(if above { Id::Above(peak) } else { Id::Below(peak) });
        }
        start.extend(slope.iter().enumerate().map(|(j, s)| if *s > 0.0 { Id::Low(j) } else { Id::High(j) }));
        start.extend(self.of.bounds.map(|_| Id::Floor));
        start
    }
}

/// Keeps the row that is violated most.
fn note(worst: &mut (f64, Option<Id>), violation: f64, id: Id) {
    if violation > worst.0 {
        *worst = (violation, Some(id));
    }
}

impl Rows for Program<'_> {
    type Id = Id;

    fn reach(&self, variable: usize) -> f64 {
        if variable < self.of.count { 1.0 } else { f64::MAX.sqrt() }
    }

    fn worst(&mut self, x: &[f64]) -> Option<Id> {
        let (k, radius) = (self.of.count, self.of.radius);
        let (z, u) = (&x[..k], x[x.len() - 1]);
        let s = if self.of.bounds.is_some() { x[k] } else { 0.0 };
        let mut worst = (SLACK, None);
        if self.of.normed() {
            let t = u + self.share * s;
            for (i, r) in self.of.residuals.iter().enumerate() {
                let along = self.dot(self.of.along, i, z);
                note(&mut worst, (r - self.top) / radius + along - t, Id::Above(i));
                note(&mut worst, (-r - self.top) / radius - along - t, Id::Below(i));
            }
        }
        if let Some((bounds, along)) = self.of.bounds {
            for (i, (g, equal)) in bounds.values.iter().zip(&bounds.equal).enumerate() {
                let along = self.dot(along, i, z);
                note(&mut worst, -(g + self.over) / radius - along - s, Id::Kept(i));
                if *equal {
                    note(&mut worst, (g - self.over) / radius + along - s, Id::Equal(i));
                }
            }
            note(&mut worst, -self.over / radius - s, Id::Floor);
        }
        for (j, z) in z.iter().enumerate() {
            note(&mut worst, z - 1.0, Id::High(j));
            note(&mut worst, -z - 1.0, Id::Low(j));
        }
        worst.1
    }

    fn row(&self, id: Id, into: &mut [f64]) -> f64 {
        let (k, radius, last) = (self.of.count, self.of.radius, into.len() - 1);
        into.fill(0.0);
        let mut fill = |along: &[f64], i: usize, sign: f64| {
            into[..k].iter_mut().zip(&along[i * k..]).for_each(|(v, a)| *v = sign * a);
        };
        match id {
            Id::Above(i) | Id::Below(i) => {
                let sign = if matches!(id, Id::Above(_)) { 1.0 } else { -1.0 };
                fill(self.of.along, i, sign);
                if self.of.bounds.is_some() {
                    into[k] = -self.share;
                }
                into[last] = -1.0;
                (self.top - sign * self.of.residuals[i]) / radius
            }
            Id::Kept(i) | Id::Equal(i) => {
                let Some((bounds, along)) = self.of.bounds else { return 0.0 };
                let sign = if matches!(id, Id::Kept(_)) { -1.0 } else { 1.0 };
                fill(along, i, sign);
                into[k] = -1.0;
                (self.over - sign * bounds.values[i]) / radius
            }
            Id::Floor => {
                into[k] = -1.0;
                self.over / radius
            }
            Id::Low(j) | Id::High(j) => {
                into[j] = if matches!(id, Id::High(_)) { 1.0 } else { -1.0 };
                1.0
            }
        }
    }
}
