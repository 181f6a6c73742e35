//! Linear and convex quadratic programs, by clarabel's interior points.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use nalgebra::DMatrix;

/// minimise x P x / 2 + cost x subject to A x <= right, A given by columns.
pub(super) struct Convex {
    /// P of the first variables; the others are linear.
    pub quadratic: Option<DMatrix<f64>>,
    pub cost: Vec<f64>,
    pub columns: Vec<Vec<(usize, f64)>>,
    pub right: Vec<f64>,
}

impl Convex {
    /// The minimum; none if the solver fails.
    pub fn solve(&self) -> Option<Vec<f64>> {
        let (m, n) = (self.right.len(), self.columns.len());
        let a = sparse(m, self.columns.iter().cloned());
        let p = match &self.quadratic {
            None => CscMatrix::zeros((n, n)),
            Some(p) => {
                let upper = |j: usize| {
                    let rows = if j < p.ncols() { 0..j + 1 } else { 0..0 };
                    rows.map(|i| (i, p[(i, j)])).collect::<Vec<_>>()
                };
                sparse(n, (0..n).map(upper))
            }
        };
        let settings = DefaultSettings {
            verbose: false,
            max_threads: 1,
            tol_gap_abs: 1e-10,
            tol_gap_rel: 1e-10,
            tol_feas: 1e-10,
            ..DefaultSettings::default()
        };
        let mut solver =
            DefaultSolver::new(&p, &self.cost, &a, &self.right, &[NonnegativeConeT(m)], settings).ok()?;
        solver.solve();
        let done = matches!(
            solver.solution.status,
            SolverStatus::Solved | SolverStatus::AlmostSolved | SolverStatus::InsufficientProgress
        );
        let solution = solver.solution.x.clone();
        (done && solution.iter().all(|x| x.is_finite())).then_some(solution)
    }
}

fn sparse(m: usize, columns: impl Iterator<Item = Vec<(usize, f64)>>) -> CscMatrix<f64> {
    let mut starts = vec![0];
    let (mut rows, mut values) = (Vec::new(), Vec::new());
    for column in columns {
        for (row, value) in column {
            rows.push(row);
            values.push(value);
        }
        starts.push(rows.len());
    }
    CscMatrix::new(m, starts.len() - 1, starts, rows, values)
}
