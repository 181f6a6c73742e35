//! The convex program of a step: the linearised residuals' norm, smallest within a box, constraints
//! kept.
//!
//! The largest |r + J d| makes it a linear program, a p-norm's quadratic model a quadratic one.
//! Violations of linearised constraints are one more variable s, so that every program has a
//! solution: minimise weight * norm + s.

use nalgebra::{DMatrix, DVector};

use super::bounds::LinearBounds;
use super::convex::Convex;
use super::objective::{Linear, largest};
use super::power::{Model, PNorm};
use super::reduce::{Triangle, reduce};

/// Directions whose part of the Jacobian is below this are left alone.
const NEGLIGIBLE: f64 = 1e-10;

/// Programs per step: each adds the rows that the last one violated.
const ROUNDS: usize = 12;

/// Violations below this part of the bound are accepted.
const SLACK: f64 = 1e-5;

/// What a step is to make small.
pub(super) enum Aim<'a> {
    /// The largest residual.
    Largest,
    /// A p-norm, by its model at the point.
    Power(PNorm, &'a Model),
}

/// A linearised problem in coordinates where its Jacobian is orthonormal, so that a box is a fair
/// trust region.
pub(super) struct Program<'a> {
    aim: Aim<'a>,
    linear: &'a Linear,
    bounds: Option<&'a LinearBounds>,
    /// Weight of the norm against violations; 0: only violations count.
    weight: f64,
    /// d = basis z; columns of unit rms effect on the residuals (and on the constraints).
    basis: DMatrix<f64>,
    /// Rows of residuals in the program.
    rows: Vec<usize>,
    /// Rows of constraints in the program.
    kept: Vec<usize>,
}

/// A step, and what the model says of it.
pub(super) struct Step {
    pub step: Vec<f64>,
    /// weight * norm + violation after the step, by the model.
    pub predicted: f64,
    /// No step in the box makes that smaller than this.
    pub bound: f64,
    /// Whether the box holds the step back.
    pub held: bool,
    /// Whether a constraint holds it back.
    pub bounded: bool,
}

impl<'a> Program<'a> {
    pub fn new(
        aim: Aim<'a>,
        linear: &'a Linear,
        bounds: Option<&'a LinearBounds>,
        weight: f64,
    ) -> Program<'a> {
        let count = linear.residuals.len() as f64;
        let triangle = bounds.map(|bounds| joined(linear, bounds));
        let basis = basis(triangle.as_ref().unwrap_or(&linear.triangle)) * count.sqrt();
        let rows = match aim {
            Aim::Largest => peaks(&linear.residuals, 16 * basis.ncols().max(4)),
            Aim::Power(..) => Vec::new(),
        };
        let mut program = Program { aim, linear, bounds, weight, basis, rows, kept: Vec::new() };
        let values = bounds.map_or(Vec::new(), |b| b.values.clone());
        program.keep(&values);
        program
    }

    /// The best step within |z| <= radius. None if the programs fail.
    pub fn step(&mut self, radius: f64) -> Option<Step> {
        let mut last = None;
        for _ in 0..ROUNDS {
            let (z, bound, violation) = self.solve(radius)?;
            let step = &self.basis * DVector::from_column_slice(&z);
            let step = step.as_slice().to_vec();
            let kept = self.bounds.map_or(Vec::new(), |b| b.moved(&step));
            let worst = self.bounds.map_or(0.0, |b| b.worst(&kept));
            let (norm, over) = self.look(&step, bound);
            let held = z.iter().any(|z| z.abs() > 0.99 * radius);
            let predicted = self.weight * norm + worst;
            let bound = (self.weight * bound + violation).min(predicted);
            let bounded = self.bounds.is_some_and(|b| b.touches(&kept, worst + SLACK * radius));
            last = Some(Step { step, predicted, bound, held, bounded });
            let before = self.rows.len() + self.kept.len();
            self.add(&over);
            if worst > violation + SLACK * (violation + radius * SLACK) {
                self.keep(&kept);
            }
            if self.rows.len() + self.kept.len() == before {
                break;
            }
        }
        last
    }

    /// The norm after a step by the model, and the residuals above the bound (others 0).
    fn look(&self, step: &[f64], bound: f64) -> (f64, Vec<f64>) {
        match self.aim {
            Aim::Largest => {
                let moved = moved(self.linear, step);
                let above = |m: &f64| if m.abs() > bound * (1.0 + SLACK) { *m } else { 0.0 };
                (largest(&moved), moved.iter().map(above).collect())
            }
            Aim::Power(norm, model) => (norm.predicted(model, step), Vec::new()),
        }
    }

    /// Adds the peaks of residuals above the bound.
    fn add(&mut self, over: &[f64]) {
        let found = peaks(over, 8 * self.basis.ncols().max(4));
        self.rows.extend(found.into_iter().filter(|&i| over[i] != 0.0));
        self.rows.sort_unstable();
        self.rows.dedup();
    }

    /// Adds the equations, and the constraints that are closest to being violated, or most so.
    fn keep(&mut self, values: &[f64]) {
        let Some(bounds) = self.bounds else { return };
        let ease = |i: usize| if bounds.equal[i] { -values[i].abs() } else { values[i] };
        let mut order: Vec<usize> = (0..values.len()).filter(|i| !self.kept.contains(i)).collect();
        order.sort_by(|&a, &b| ease(a).total_cmp(&ease(b)).then(a.cmp(&b)));
        let count = 8 * self.basis.ncols().max(4);
        self.kept.extend(order.into_iter().take(count));
        self.kept.sort_unstable();
    }

    /// Solves for the rows: z, the norm and the violation. All in units of the radius within the
    /// program.
    fn solve(&self, radius: f64) -> Option<(Vec<f64>, f64, f64)> {
        let k = self.basis.ncols();
        let mut rows = Lines { columns: vec![Vec::new(); k], right: Vec::new() };
        let level = (matches!(self.aim, Aim::Largest) && self.weight > 0.0).then(|| rows.variable());
        let excess = self.bounds.map(|_| rows.variable());
        for &i in if level.is_some() { self.rows.as_slice() } else { &[] } {
            let along = self.along(&self.linear.jacobian, i);
            let residual = self.linear.residuals[i] / radius;
            for sign in [1.0, -1.0] {
                rows.add(&along, sign, level, -sign * residual);
            }
        }
        if let Some(bounds) = self.bounds {
            for &i in &self.kept {
                let (along, value) = (self.along(&bounds.jacobian, i), bounds.values[i] / radius);
                rows.add(&along, -1.0, excess, value);
                if bounds.equal[i] {
                    rows.add(&along, 1.0, excess, -value);
                }
            }
            rows.floor(excess);
        }
        rows.fence(k);
        let mut cost = vec![0.0; rows.columns.len()];
        level.into_iter().for_each(|at| cost[at] = 1.0);
        // The norm keeps its size however small its weight, or it would drown in the solver's
        // tolerance.
        excess.into_iter().for_each(|at| cost[at] = if self.weight > 0.0 { 1.0 / self.weight } else { 1.0 });
        let quadratic = self.quadratic(radius, &mut cost);
        let Lines { columns, right } = rows;
        let x = Convex { quadratic, cost, columns, right }.solve()?;
        let z: Vec<f64> = x[..k].iter().map(|z| z * radius).collect();
        let violation = excess.map_or(0.0, |at| x[at].max(0.0) * radius);
        let norm = match (level, &self.aim) {
            (Some(at), _) => x[at].max(0.0) * radius,
            (None, Aim::Power(norm, model)) => {
                norm.predicted(model, (&self.basis * DVector::from_column_slice(&z)).as_slice())
            }
            (None, Aim::Largest) => 0.0,
        };
        Some((z, norm, violation))
    }

    /// The quadratic model of a p-norm in units of the radius; its linear part is added to the
    /// cost.
    fn quadratic(&self, radius: f64, cost: &mut [f64]) -> Option<DMatrix<f64>> {
        let Aim::Power(norm, model) = &self.aim else { return None };
        if self.weight == 0.0 {
            return None;
        }
        // c |Q z + q|^2, divided by the radius
        let q = &model.triangle.r * &self.basis;
        let factor = 2.0 * norm.curvature(model);
        let linear = q.transpose() * &model.triangle.q * factor;
        cost.iter_mut().zip(linear.iter()).for_each(|(c, l)| *c += l);
        Some(q.transpose() * q * (factor * radius))
    }

    /// A row of a matrix along the basis.
    fn along(&self, matrix: &[f64], i: usize) -> Vec<f64> {
        let n = self.basis.nrows();
        let row = &matrix[i * n..(i + 1) * n];
        let dot =
            |column: nalgebra::DVectorView<f64>| row.iter().zip(column.iter()).map(|(a, b)| a * b).sum();
        self.basis.column_iter().map(dot).collect()
    }
}

/// Rows A x <= right, by columns.
struct Lines {
    columns: Vec<Vec<(usize, f64)>>,
    right: Vec<f64>,
}

impl Lines {
    /// One more variable.
    fn variable(&mut self) -> usize {
        self.columns.push(Vec::new());
        self.columns.len() - 1
    }

    /// sign along z - x_other <= right
    fn add(&mut self, along: &[f64], sign: f64, other: Option<usize>, right: f64) {
        let row = self.right.len();
        for (column, value) in self.columns.iter_mut().zip(along) {
            column.push((row, sign * value));
        }
        other.into_iter().for_each(|at| self.columns[at].push((row, -1.0)));
        self.right.push(right);
    }

    /// x_at >= 0
    fn floor(&mut self, at: Option<usize>) {
        at.into_iter().for_each(|at| self.columns[at].push((self.right.len(), -1.0)));
        self.right.push(0.0);
    }

    /// |x_j| <= 1 for the first k.
    fn fence(&mut self, k: usize) {
        for column in &mut self.columns[..k] {
            let row = self.right.len();
            column.extend([(row, 1.0), (row + 1, -1.0)]);
            self.right.extend([1.0, 1.0]);
        }
    }
}

/// r + J d
pub(super) fn moved(linear: &Linear, step: &[f64]) -> Vec<f64> {
    let n = step.len();
    let row = |i: usize| &linear.jacobian[i * n..(i + 1) * n];
    let residuals = linear.residuals.iter().enumerate();
    residuals.map(|(i, r)| r + row(i).iter().zip(step).map(|(j, d)| j * d).sum::<f64>()).collect()
}

/// The triangle of the residuals' and the constraints' rows, both of equal weight however many they
/// are.
pub(super) fn joined(linear: &Linear, bounds: &LinearBounds) -> Triangle {
    let n = linear.triangle.r.ncols();
    let root = (linear.residuals.len() as f64 / bounds.values.len() as f64).sqrt();
    let mut jacobian: Vec<f64> = linear.triangle.r.transpose().iter().copied().collect();
    jacobian.extend(bounds.jacobian.iter().map(|a| a * root));
    let mut residuals: Vec<f64> = linear.triangle.q.iter().copied().collect();
    residuals.extend(bounds.values.iter().map(|g| g * root));
    reduce(&jacobian, &residuals, n)
}

/// d = basis z such that J basis has orthonormal columns, without the directions that J does not
/// see: R = U S V^T (columns scaled to length 1) gives basis = D V S^-1.
pub(super) fn basis(triangle: &Triangle) -> DMatrix<f64> {
    let n = triangle.r.ncols();
    let norms = triangle.column_norms();
    let svd = triangle.scaled().svd(false, true);
    let Some(v) = svd.v_t else { return DMatrix::zeros(n, 0) };
    let top = svd.singular_values.iter().copied().fold(0.0, f64::max);
    let kept: Vec<usize> = (0..n).filter(|&k| svd.singular_values[k] > NEGLIGIBLE * top).collect();
    DMatrix::from_fn(n, kept.len(), |j, k| {
        let direction = v[(kept[k], j)] / svd.singular_values[kept[k]];
        if norms[j] > 0.0 { direction / norms[j] } else { 0.0 }
    })
}

/// The largest residual of each of `pieces` runs of samples, and the largest of all: rows spread
/// over the samples.
pub(super) fn peaks(residuals: &[f64], pieces: usize) -> Vec<usize> {
    let length = residuals.len().div_ceil(pieces.max(1)).max(1);
    let mut rows: Vec<usize> = Vec::new();
    for (piece, run) in residuals.chunks(length).enumerate() {
        let mut best = 0;
        for (i, r) in run.iter().enumerate() {
            if r.abs() > run[best].abs() {
                best = i;
            }
        }
        rows.push(piece * length + best);
    }
    rows
}
