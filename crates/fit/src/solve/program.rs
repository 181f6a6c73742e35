//! The convex program of a step: the linearised residuals' norm, smallest within a box, constraints
//! kept.
//!
//! The largest |r + J d| makes it a linear program ([`super::vertex`]), a p-norm's quadratic model a
//! quadratic one. Violations of linearised constraints are one more variable s, so that every program
//! has a solution: minimise weight * norm + s.

use nalgebra::{DMatrix, DVector};

use super::bounds::LinearBounds;
use super::convex::Convex;
use super::objective::{Linear, largest};
use super::power::{Model, PNorm};
use super::reduce::{Triangle, reduce};
use super::vertex::{Lowest, Minimax};

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
    /// The Jacobians of the residuals, where the largest counts, and of the constraints along the
    /// basis, row by row.
    along: Vec<f64>,
    kept_along: Vec<f64>,
    /// Rows of constraints in a p-norm's program.
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
        let along = match aim {
            Aim::Largest => along(&linear.jacobian, &basis),
            Aim::Power(..) => Vec::new(),
        };
        let kept_along = bounds.map_or(Vec::new(), |bounds| self::along(&bounds.jacobian, &basis));
        let kept = Vec::new();
        let mut program = Program { aim, linear, bounds, weight, basis, along, kept_along, kept };
        if matches!(program.aim, Aim::Power(..)) {
            program.keep(&bounds.map_or(Vec::new(), |b| b.values.clone()));
        }
        program
    }

    /// The best step within |z| <= radius. None if the program fails.
    pub fn step(&mut self, radius: f64) -> Option<Step> {
        match self.aim {
            Aim::Largest => {
                let bounds = self.bounds.map(|bounds| (bounds, self.kept_along.as_slice()));
                let (residuals, along) = (self.linear.residuals.as_slice(), self.along.as_slice());
                let (weight, count) = (self.weight, self.basis.ncols());
                let Lowest { z, bound } =
                    Minimax { residuals, along, bounds, weight, radius, count }.lowest()?;
                let norm = largest(&moved(self.linear, &self.along_basis(&z)));
                Some(self.taken(&z, norm, bound, radius).0)
            }
            Aim::Power(norm, model) => self.rounds(norm, model, radius),
        }
    }

    fn along_basis(&self, z: &[f64]) -> Vec<f64> {
        (&self.basis * DVector::from_column_slice(z)).as_slice().to_vec()
    }

    /// A step by its coordinates, what the model says of it, the constraints after it and their worst.
    fn taken(&self, z: &[f64], norm: f64, bound: f64, radius: f64) -> (Step, Vec<f64>, f64) {
        let step = self.along_basis(z);
        let kept = self.bounds.map_or(Vec::new(), |b| b.moved(&step));
        let worst = self.bounds.map_or(0.0, |b| b.worst(&kept));
        let held = z.iter().any(|z| z.abs() > 0.99 * radius);
        let predicted = self.weight * norm + worst;
        let bounded = self.bounds.is_some_and(|b| b.touches(&kept, worst + SLACK * radius));
        (Step { step, predicted, bound: bound.min(predicted), held, bounded }, kept, worst)
    }

    /// The step of a p-norm: constraints that a program violates are in the next.
    fn rounds(&mut self, norm: PNorm, model: &Model, radius: f64) -> Option<Step> {
        let mut last = None;
        for _ in 0..ROUNDS {
            let (z, violation) = self.solve(norm, model, radius)?;
            let value = norm.predicted(model, &self.along_basis(&z));
            let (step, kept, worst) = self.taken(&z, value, self.weight * value + violation, radius);
            last = Some(step);
            let before = self.kept.len();
            if worst > violation + SLACK * (violation + radius * SLACK) {
                self.keep(&kept);
            }
            if self.kept.len() == before {
                break;
            }
        }
        last
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

    /// Solves for the constraints that are kept: z and the violation. All in units of the radius
    /// within the program.
    fn solve(&self, norm: PNorm, model: &Model, radius: f64) -> Option<(Vec<f64>, f64)> {
        let k = self.basis.ncols();
        let mut rows = Lines { columns: vec![Vec::new(); k], right: Vec::new() };
        let excess = self.bounds.map(|_| rows.variable());
        if let Some(bounds) = self.bounds {
            for &i in &self.kept {
                let (along, value) = (&self.kept_along[i * k..(i + 1) * k], bounds.values[i] / radius);
                rows.add(along, -1.0, excess, value);
                if bounds.equal[i] {
                    rows.add(along, 1.0, excess, -value);
                }
            }
            rows.floor(excess);
        }
        rows.fence(k);
        let mut cost = vec![0.0; rows.columns.len()];
        // The norm keeps its size however small its weight, or it would drown in the solver's
        // tolerance.
        excess.into_iter().for_each(|at| cost[at] = if self.weight > 0.0 { 1.0 / self.weight } else { 1.0 });
        let quadratic = self.quadratic(norm, model, radius, &mut cost);
        let Lines { columns, right } = rows;
        let x = Convex { quadratic, cost, columns, right }.solve()?;
        let z: Vec<f64> = x[..k].iter().map(|z| z * radius).collect();
        Some((z, excess.map_or(0.0, |at| x[at].max(0.0) * radius)))
    }

    /// The quadratic model of a p-norm in units of the radius; its linear part is added to the
    /// cost.
    fn quadratic(&self, norm: PNorm, model: &Model, radius: f64, cost: &mut [f64]) -> Option<DMatrix<f64>> {
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
}

/// The rows of a matrix along the columns of a basis.
fn along(matrix: &[f64], basis: &DMatrix<f64>) -> Vec<f64> {
    let row = |row: &[f64]| {
        let dot =
            |column: nalgebra::DVectorView<f64>| row.iter().zip(column.iter()).map(|(a, b)| a * b).sum();
        basis.column_iter().map(dot).collect::<Vec<f64>>()
    };
    matrix.chunks_exact(basis.nrows()).flat_map(row).collect()
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
