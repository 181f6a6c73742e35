//! Among coefficients of one largest residual, those of the least mean square.
//!
//! Where constraints, or the formula itself, hold the largest residual in a few places that not
//! every parameter reaches, the others are free within wide limits and the linear programs leave
//! them anywhere. From there, quadratic programs lower the mean square with no residual above the
//! largest and the constraints kept.

use nalgebra::{DMatrix, DVector};

use super::bounds::{Bounds, LinearBounds};
use super::constrained::kept;
use super::convex::Convex;
use super::escape::kernel;
use super::fitted::{Gap, Method, Stage, Termination};
use super::objective::{Linear, Objective, largest, rms};
use super::program::{basis, joined, moved, peaks};
use super::route::Route;

/// The largest residual may rise by this part, which is nothing in f32; half of it is the programs'
/// own.
const SAME: f64 = 1e-7;

/// What is left of the mean square's root is below this part of what it was, or the coefficients
/// stay.
const WORTH: f64 = 0.99;

/// Quadratic programs, and rounds of each: a round adds the rows that the last one violated.
const STEPS: usize = 40;
const ROUNDS: usize = 12;

/// Singular values below this part of the largest are none.
const NONE: f64 = 1e-9;

/// Steps are given up below this part of the first radius.
const COLLAPSED: f64 = 1e-4;

/// Of coefficients with the largest residual of these, those of the least mean square near them, if
/// that is lower by 1 % or more.
pub(super) fn settled(objective: &Objective, bounds: Option<&Bounds>, found: Route) -> Route {
    let settles = matches!(
        found.termination,
        Termination::Minimax | Termination::GlobalMinimax | Termination::Constrained
    );
    let residuals = objective.residuals(&found.coefficients);
    let Some(residuals) = residuals.ok().filter(|_| settles) else { return found };
    let (max, before) = (largest(&residuals), rms(&residuals));
    let cap = max * (1.0 + SAME);
    let (coefficients, evaluations) = lowered(objective, bounds, &found.coefficients, cap);
    let Ok(residuals) = objective.residuals(&coefficients) else { return found };
    let (max, rms) = (largest(&residuals), rms(&residuals));
    if max > cap || rms > WORTH * before {
        return found;
    }
    let mut stages = found.stages;
    stages.push(Stage { method: Method::Ties, end: found.termination, max, rms });
    let gap = match (found.gap, found.bound) {
        (Gap::Global(_), Some(bound)) => Gap::Global(((max - bound) / max).max(0.0)),
        (gap, _) => gap,
    };
    Route { coefficients, stages, gap, evaluations: found.evaluations + evaluations, ..found }
}

/// The end of a descent of the mean square with no residual above the cap, and its evaluations.
fn lowered(objective: &Objective, bounds: Option<&Bounds>, start: &[f64], cap: f64) -> (Vec<f64>, u64) {
    let (mut at, mut evaluations) = (start.to_vec(), 0);
    let mut radius = None;
    for _ in 0..STEPS {
        let Ok(linear) = objective.linearise(&at) else { break };
        let Ok(held) = bounds.map(|b| b.linearise(&at)).transpose() else { break };
        let here = rms(&linear.residuals);
        let mut size = radius.unwrap_or(here);
        let program = Program::new(&linear, held.as_ref(), cap * (1.0 - 0.5 * SAME));
        let next = loop {
            evaluations += 1;
            let Some(step) = program.step(size) else { return (at, evaluations) };
            let promised = here - rms(&moved(&linear, &step));
            let point: Vec<f64> = at.iter().zip(&step).map(|(p, d)| p + d).collect();
            let value = objective.residuals(&point).ok().filter(|r| largest(r) <= cap).map(|r| rms(&r));
            let gained = value.filter(|_| bounds.is_none_or(|b| kept(b, &point))).map(|v| here - v);
            if promised <= 0.1 * (1.0 - WORTH) * here {
                return (at, evaluations);
            }
            if gained.is_some_and(|gained| gained > 0.1 * promised) {
                break point;
            }
            size *= 0.25;
            if size < COLLAPSED * here {
                return (at, evaluations);
            }
        };
        radius = Some(2.0 * size);
        at = next;
    }
    (at, evaluations)
}

/// The mean square of the linearised residuals, smallest under the cap.
struct Program<'a> {
    linear: &'a Linear,
    held: Option<&'a LinearBounds>,
    cap: f64,
    /// d = basis z; equations do not see it.
    basis: DMatrix<f64>,
}

impl<'a> Program<'a> {
    fn new(linear: &'a Linear, held: Option<&'a LinearBounds>, cap: f64) -> Program<'a> {
        let triangle = held.map(|held| joined(linear, held));
        let all =
            basis(triangle.as_ref().unwrap_or(&linear.triangle)) * (linear.residuals.len() as f64).sqrt();
        let basis = match held.map(|held| equations(held, all.nrows())) {
            Some(rows) if rows.nrows() > 0 => {
                let free = kernel(&(rows * &all), NONE, &vec![1.0; all.ncols()]);
                let columns: Vec<DVector<f64>> = free.into_iter().map(DVector::from_vec).collect();
                if columns.is_empty() {
                    DMatrix::zeros(all.nrows(), 0)
                } else {
                    all * DMatrix::from_columns(&columns)
                }
            }
            _ => all,
        };
        Program { linear, held, cap, basis }
    }

    /// The step of the smallest mean square within |z| <= radius; none where nothing can move or
    /// the program fails.
    fn step(&self, radius: f64) -> Option<Vec<f64>> {
        let k = self.basis.ncols();
        if k == 0 {
            return None;
        }
        let mut rows = peaks(&self.linear.residuals, 16 * k.max(4));
        let mut kept = self.held.map_or(Vec::new(), |held| lowest(&held.values, &held.equal, 8 * k.max(4)));
        let mut last = None;
        for _ in 0..ROUNDS {
            let z = self.solve(radius, &rows, &kept)?;
            let step = (&self.basis * DVector::from_vec(z)).as_slice().to_vec();
            let before = rows.len() + kept.len();
            let excess = |r: f64| if r.abs() > self.cap { r } else { 0.0 };
            let over: Vec<f64> = moved(self.linear, &step).into_iter().map(excess).collect();
            rows.extend(peaks(&over, 8 * k.max(4)).into_iter().filter(|&i| over[i] != 0.0));
            if let Some(held) = self.held {
                let values = held.moved(&step);
                let broken = lowest(&values, &held.equal, 8 * k.max(4)).into_iter();
                kept.extend(broken.filter(|&i| values[i] < 0.0));
            }
            for list in [&mut rows, &mut kept] {
                list.sort_unstable();
                list.dedup();
            }
            last = Some(step);
            if rows.len() + kept.len() == before {
                break;
            }
        }
        last
    }

    /// The program of some rows, in units of the radius.
    fn solve(&self, radius: f64, rows: &[usize], kept: &[usize]) -> Option<Vec<f64>> {
        let (n, k) = (self.basis.nrows(), self.basis.ncols());
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); k];
        let mut right = Vec::new();
        let mut add = |along: &DVector<f64>, sign: f64, bound: f64| {
            for (column, value) in columns.iter_mut().zip(along.iter()) {
                column.push((right.len(), sign * value));
            }
            // Where rounding has it just beyond its bound, it stays there.
            right.push((bound / radius).max(0.0));
        };
        let along = |matrix: &[f64], i: usize| {
            self.basis.tr_mul(&DVector::from_column_slice(&matrix[i * n..(i + 1) * n]))
        };
        for &i in rows {
            let (row, residual) = (along(&self.linear.jacobian, i), self.linear.residuals[i]);
            add(&row, 1.0, self.cap - residual);
            add(&row, -1.0, self.cap + residual);
        }
        for (&i, held) in kept.iter().flat_map(|i| self.held.map(|held| (i, held))) {
            add(&along(&held.jacobian, i), -1.0, held.values[i]);
        }
        for j in 0..k {
            let unit = DVector::from_fn(k, |i, _| f64::from(u8::from(i == j)));
            add(&unit, 1.0, radius);
            add(&unit, -1.0, radius);
        }
        let triangle = &self.linear.triangle;
        let length = triangle.residual_norm();
        let q = &triangle.r * &self.basis * (radius / length);
        let cost = (q.transpose() * &triangle.q / length).as_slice().to_vec();
        let z = Convex { quadratic: Some(q.transpose() * q), cost, columns, right }.solve()?;
        Some(z.into_iter().map(|z| z * radius).collect())
    }
}

/// The derivatives of equations.
fn equations(held: &LinearBounds, n: usize) -> DMatrix<f64> {
    let rows: Vec<usize> = (0..held.equal.len()).filter(|&i| held.equal[i]).collect();
    DMatrix::from_fn(rows.len(), n, |i, j| held.jacobian[rows[i] * n + j])
}

/// The inequalities that are closest to being violated.
fn lowest(values: &[f64], equal: &[bool], count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).filter(|&i| !equal[i]).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]).then(a.cmp(&b)));
    order.truncate(count);
    order
}
