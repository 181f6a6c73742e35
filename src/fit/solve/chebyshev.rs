//! The linear Chebyshev problem: the step that makes the largest of |r + J d| smallest within a box, by linear
//! programs over the rows that matter.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use nalgebra::{DMatrix, DVector};

use super::objective::{Linear, largest};
use super::reduce::Triangle;

/// Directions whose part of the Jacobian is below this are left alone.
const NEGLIGIBLE: f64 = 1e-10;

/// Linear programs per step: each adds the rows that the last one violated.
const ROUNDS: usize = 12;

/// Violations below this part of the bound are accepted.
const SLACK: f64 = 1e-5;

/// A linearised residual in coordinates where its Jacobian is orthonormal, so that a box is a fair trust region.
pub(super) struct Chebyshev<'a> {
    linear: &'a Linear,
    /// d = basis z; columns of unit rms effect on the residuals.
    basis: DMatrix<f64>,
    /// Rows of the program.
    rows: Vec<usize>,
}

/// A step, and what the linear model says of it.
pub(super) struct Step {
    pub step: Vec<f64>,
    /// Largest |r + J d|.
    pub predicted: f64,
    /// No step in the box makes the largest |r + J d| smaller than this.
    pub bound: f64,
    /// Whether the box holds the step back.
    pub held: bool,
}

impl<'a> Chebyshev<'a> {
    pub fn new(linear: &'a Linear) -> Chebyshev<'a> {
        let count = linear.residuals.len() as f64;
        let basis = basis(&linear.triangle) * count.sqrt();
        let rows = peaks(&linear.residuals, 16 * basis.ncols().max(4));
        Chebyshev { linear, basis, rows }
    }

    /// The best step within |z| <= radius. None if the programs fail.
    pub fn step(&mut self, radius: f64) -> Option<Step> {
        let mut last = None;
        for _ in 0..ROUNDS {
            let (z, bound) = self.program(radius)?;
            let step = &self.basis * DVector::from_column_slice(&z);
            let moved = self.moved(step.as_slice());
            let predicted = largest(&moved);
            let held = z.iter().any(|z| z.abs() > 0.99 * radius);
            last = Some(Step { step: step.as_slice().to_vec(), predicted, bound, held });
            let over: Vec<f64> =
                moved.iter().map(|m| if m.abs() > bound * (1.0 + SLACK) { *m } else { 0.0 }).collect();
            let before = self.rows.len();
            let found = peaks(&over, 8 * self.basis.ncols().max(4));
            self.rows.extend(found.into_iter().filter(|&i| over[i] != 0.0));
            self.rows.sort_unstable();
            self.rows.dedup();
            if self.rows.len() == before {
                break;
            }
        }
        last
    }

    /// r + J d
    fn moved(&self, step: &[f64]) -> Vec<f64> {
        let n = step.len();
        let row = |i: usize| &self.linear.jacobian[i * n..(i + 1) * n];
        let residuals = self.linear.residuals.iter().enumerate();
        residuals.map(|(i, r)| r + row(i).iter().zip(step).map(|(j, d)| j * d).sum::<f64>()).collect()
    }

    /// Solves: minimise t, |r_i + (J basis z)_i| <= t for the rows, |z| <= radius; in units of the radius.
    fn program(&self, radius: f64) -> Option<(Vec<f64>, f64)> {
        let (n, k) = (self.basis.nrows(), self.basis.ncols());
        let count = self.rows.len();
        let constraints = 2 * count + 2 * k;
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::with_capacity(2 * count + 2); k + 1];
        let mut right = vec![0.0; constraints];
        for (slot, &i) in self.rows.iter().enumerate() {
            let row = &self.linear.jacobian[i * n..(i + 1) * n];
            for (j, column) in columns.iter_mut().enumerate().take(k) {
                let value: f64 = row.iter().zip(self.basis.column(j).iter()).map(|(a, b)| a * b).sum();
                column.extend([(2 * slot, value), (2 * slot + 1, -value)]);
            }
            columns[k].extend([(2 * slot, -1.0), (2 * slot + 1, -1.0)]);
            right[2 * slot] = -self.linear.residuals[i] / radius;
            right[2 * slot + 1] = self.linear.residuals[i] / radius;
        }
        for (j, column) in columns.iter_mut().enumerate().take(k) {
            let at = 2 * count + 2 * j;
            column.extend([(at, 1.0), (at + 1, -1.0)]);
            right[at] = 1.0;
            right[at + 1] = 1.0;
        }
        let solution = solve(&columns, &right)?;
        let (z, t) = solution.split_at(k);
        Some((z.iter().map(|z| z * radius).collect(), t[0].max(0.0) * radius))
    }
}

/// Minimises the last variable subject to A x <= b, A given by columns.
fn solve(columns: &[Vec<(usize, f64)>], right: &[f64]) -> Option<Vec<f64>> {
    let (m, n) = (right.len(), columns.len());
    let mut starts = vec![0];
    let (mut rows, mut values) = (Vec::new(), Vec::new());
    for column in columns {
        for (row, value) in column {
            rows.push(*row);
            values.push(*value);
        }
        starts.push(rows.len());
    }
    let a = CscMatrix::new(m, n, starts, rows, values);
    let p = CscMatrix::zeros((n, n));
    let mut q = vec![0.0; n];
    q[n - 1] = 1.0;
    let settings = DefaultSettings {
        verbose: false,
        max_threads: 1,
        tol_gap_abs: 1e-10,
        tol_gap_rel: 1e-10,
        tol_feas: 1e-10,
        ..DefaultSettings::default()
    };
    let mut solver = DefaultSolver::new(&p, &q, &a, right, &[NonnegativeConeT(m)], settings).ok()?;
    solver.solve();
    let done = matches!(
        solver.solution.status,
        SolverStatus::Solved | SolverStatus::AlmostSolved | SolverStatus::InsufficientProgress
    );
    let solution = solver.solution.x.clone();
    (done && solution.iter().all(|x| x.is_finite())).then_some(solution)
}

/// d = basis z such that J basis has orthonormal columns, without the directions that J does not see: R = U S V^T
/// (columns scaled to length 1) gives basis = D V S^-1.
fn basis(triangle: &Triangle) -> DMatrix<f64> {
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

/// The largest residual of each of `pieces` runs of samples, and the largest of all: rows spread over the samples.
fn peaks(residuals: &[f64], pieces: usize) -> Vec<usize> {
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
