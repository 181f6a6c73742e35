//! The program of one level t: are there coefficients whose every residual is below t?
//!
//! |R| <= t D is linear in the coefficients, which are taken homogeneous (x_0, x_1 ...),
//! p_j = x_j / x_0, so that none can run away. With weights w_i > 0 minimise z subject to
//! |R_i| - t D_i <= z t w_i and mean(D / w) = 1: z < 0 gives coefficients with a smaller largest
//! residual, z > 0 proves that there are none.

use super::Row;
use super::columns::{Columns, NOISE};
use super::simplex::{Failure, Rows, Vertex, minimise_last};

/// Homogeneous coefficients lie within this. Columns have a largest entry of 1 beside denominators
/// of mean 1.
const BOX: f64 = 1e6;

/// x_0 is at least this: coefficients do not reach infinity.
const LEAD: f64 = 1e-7;

/// Denominators are at least this part of their sample's largest entry times x_0.
const FLOOR: f64 = 1e-7;

/// z >= -this: no bound, as D <= w times the number of samples.
const DEEPEST: f64 = 1e7;

/// A row of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Id {
    /// R - t D <= z t w
    Above(usize),
    /// -R - t D <= z t w
    Below(usize),
    /// D >= FLOOR size x_0
    Floor(usize),
    /// The caller's row; `true`: its other side, where it is an equation.
    Extra(usize, bool),
    /// -x <= BOX; for x_0, -x_0 <= -LEAD
    Lower(usize),
    /// x <= BOX
    Upper(usize),
    /// z >= -DEEPEST
    Deepest,
    /// mean(D / w) <= 1; `true`: >= 1
    Mean(bool),
}

/// The program of a level.
pub(super) struct Level<'a> {
    columns: &'a Columns,
    /// Rows in homogeneous coefficients: a x <= 0.
    extra: &'a [Row],
    /// t > 0; none: z is the largest of -D/w.
    level: Option<f64>,
    weights: Vec<f64>,
    /// Mean of each column of D / w.
    mean: Vec<f64>,
    /// Violations below this are accepted.
    slack: f64,
    residual: Vec<f64>,
    divisor: Vec<f64>,
}

/// Violations that are accepted, in parts of the level times the weight.
const SLACK: f64 = 1e-11;

impl<'a> Level<'a> {
    /// The program of a level; none: the one whose smallest D/w is largest.
    pub fn new(columns: &'a Columns, extra: &'a [Row], level: Option<f64>, weights: Vec<f64>) -> Level<'a> {
        let mean = |column: &Vec<f64>| {
            column.iter().zip(&weights).map(|(d, w)| d / w).sum::<f64>() / columns.samples as f64
        };
        let mean = columns.divisor.iter().map(mean).collect();
        let slack = SLACK.max(level.map_or(0.0, |t| NOISE / t));
        let (residual, divisor) = (Vec::new(), Vec::new());
        Level { columns, extra, level, weights, mean, slack, residual, divisor }
    }

    /// Solves the program: homogeneous coefficients and z.
    pub fn solve(&mut self, start: &[Id]) -> Result<Vertex<Id>, Failure> {
        let fallback: Vec<Id> = (0..self.columns.unit.len()).map(Id::Lower).chain([Id::Deepest]).collect();
        minimise_last(self, start, &fallback)
    }

    /// Whether a column is the one that has the coefficient 1.
    fn leads(&self, column: usize) -> bool {
        self.columns.affine && column == 0
    }

    /// The caller's row that is violated most.
    fn worst_extra(&self, x: &[f64], worst: &mut (f64, Option<Id>)) {
        for (k, row) in self.extra.iter().enumerate() {
            let value = row.coefficients.iter().zip(x).map(|(a, x)| a * x).sum::<f64>();
            let top = row.coefficients.iter().fold(f64::MIN_POSITIVE, |t, a| t.max(a.abs()));
            note(worst, value / top, Id::Extra(k, false));
            if row.equal {
                note(worst, -value / top, Id::Extra(k, true));
            }
        }
    }

    /// The worst of the samples' rows.
    fn worst_sample(&mut self, x: &[f64], z: f64, worst: &mut (f64, Option<Id>)) {
        self.columns.at(x, &mut self.residual, &mut self.divisor);
        for i in 0..self.columns.samples {
            let (r, d, w) = (self.residual[i], self.divisor[i], self.weights[i]);
            let Some(t) = self.level else {
                note(worst, -d / w - z, Id::Above(i));
                continue;
            };
            let id = if r > 0.0 { Id::Above(i) } else { Id::Below(i) };
            note(worst, (r.abs() - t * d) / (t * w) - z, id);
            if self.columns.affine {
                note(worst, (FLOOR * self.columns.size[i] * x[0] - d) / w, Id::Floor(i));
            }
        }
    }
}

fn note(worst: &mut (f64, Option<Id>), violation: f64, id: Id) {
    if violation > worst.0 {
        *worst = (violation, Some(id));
    }
}

impl Rows for Level<'_> {
    type Id = Id;

    fn reach(&self, variable: usize) -> f64 {
        if variable < self.columns.unit.len() { BOX } else { DEEPEST }
    }

    fn worst(&mut self, x: &[f64]) -> Option<Id> {
        let (x, z) = x.split_at(x.len() - 1);
        let z = z[0];
        let mut worst = (self.slack, None);
        self.worst_sample(x, z, &mut worst);
        for (j, x) in x.iter().enumerate() {
            note(&mut worst, x - BOX, Id::Upper(j));
            note(&mut worst, if self.leads(j) { LEAD - x } else { -x - BOX }, Id::Lower(j));
        }
        self.worst_extra(x, &mut worst);
        let mean = self.mean.iter().zip(x).map(|(g, x)| g * x).sum::<f64>();
        note(&mut worst, mean - 1.0, Id::Mean(false));
        note(&mut worst, 1.0 - mean, Id::Mean(true));
        note(&mut worst, -DEEPEST - z, Id::Deepest);
        worst.1
    }

    fn row(&self, id: Id, into: &mut [f64]) -> f64 {
        let last = into.len() - 1;
        into.fill(0.0);
        let mut sample = |i: usize, sign: f64| {
            let w = self.weights[i];
            for j in 0..last {
                let (r, d) = (self.columns.residual[j][i], self.columns.divisor[j][i]);
                into[j] = self.level.map_or(-d / w, |t| (sign * r - t * d) / (t * w));
            }
            into[last] = -1.0;
            0.0
        };
        match id {
            Id::Above(i) => sample(i, 1.0),
            Id::Below(i) => sample(i, -1.0),
            Id::Floor(i) => {
                let w = self.weights[i];
                (0..last).for_each(|j| into[j] = -self.columns.divisor[j][i] / w);
                into[0] += FLOOR * self.columns.size[i] / w;
                0.0
            }
            Id::Extra(k, other) => {
                let sign = if other { -1.0 } else { 1.0 };
                into.iter_mut().zip(&self.extra[k].coefficients).for_each(|(v, a)| *v = sign * a);
                0.0
            }
            Id::Lower(j) => {
                into[j] = -1.0;
                if self.leads(j) { -LEAD } else { BOX }
            }
            Id::Upper(j) => {
                into[j] = 1.0;
                BOX
            }
            Id::Deepest => {
                into[last] = -1.0;
                DEEPEST
            }
            Id::Mean(other) => {
                let sign = if other { -1.0 } else { 1.0 };
                into.iter_mut().zip(&self.mean).for_each(|(v, g)| *v = sign * g);
                sign
            }
        }
    }
}
