//! The smallest largest residual of a sum, by Lawson's rounds of weighted least squares, in a basis
//! that is orthonormal under the weights of the sum that it was grown from.

use multiversion::multiversion;
use nalgebra::{DMatrix, DVector};

/// Columns, orthonormal under weights whose sum is 1, and what they leave of a target.
pub(super) struct Frame {
    basis: Vec<Vec<f64>>,
    /// The basis times the weights.
    weighted: Vec<Vec<f64>>,
    weights: Vec<f64>,
    rest: Vec<f64>,
}

/// A sum's residuals.
pub(super) struct Level {
    /// The largest.
    pub max: f64,
    /// The weights under which least squares have it.
    pub weights: Vec<f64>,
}

/// A column whose part across the others is below this part of it depends on them.
const DEPENDENT: f64 = 1e-9;

/// The same of squares that are a difference: rounding leaves 1e-15 of them.
const CANCELLED: f64 = 1e-12;

impl Frame {
    /// None where a column depends on those before.
    pub fn new(
        columns: impl IntoIterator<Item = Vec<f64>>,
        target: &[f64],
        weights: &[f64],
    ) -> Option<Frame> {
        let mut frame = Frame {
            basis: Vec::new(),
            weighted: Vec::new(),
            weights: weights.to_vec(),
            rest: target.to_vec(),
        };
        for column in columns {
            frame.push(column)?;
        }
        Some(frame)
    }

    /// One column more; none where it depends on those before.
    pub fn push(&mut self, column: Vec<f64>) -> Option<()> {
        let across = self.across(column)?;
        let weighted: Vec<f64> = self.weights.iter().zip(&across).map(|(w, x)| w * x).collect();
        let along = product(&weighted, &self.rest);
        take(&mut self.rest, along, &across);
        self.weighted.push(weighted);
        self.basis.push(across);
        Some(())
    }

    /// A column without its parts along the basis, of length 1.
    pub fn across(&self, mut column: Vec<f64>) -> Option<Vec<f64>> {
        let whole = dot(&self.weights, &column, &column).sqrt();
        for (own, weighted) in self.basis.iter().zip(&self.weighted) {
            let along = product(weighted, &column);
            take(&mut column, along, own);
        }
        let length = dot(&self.weights, &column, &column).sqrt();
        if length.is_nan() || length <= DEPENDENT * whole {
            return None;
        }
        column.iter_mut().for_each(|x| *x /= length);
        Some(column)
    }

    /// What a column takes away of the weighted squares; 0 where it depends on the basis.
    pub fn gain(&self, column: &[f64]) -> f64 {
        let weighted: Vec<f64> = self.weights.iter().zip(column).map(|(w, x)| w * x).collect();
        let whole = product(&weighted, column);
        let square = |own: &Vec<f64>| {
            let along = product(&weighted, own);
            along * along
        };
        let across = whole - self.basis.iter().map(square).sum::<f64>();
        if across > CANCELLED * whole { square(&self.rest) / across } else { 0.0 }
    }

    /// The sets of one or two columns across the basis that take most away of the weighted squares.
    pub fn best(&self, columns: &[&[f64]], sets: Vec<Vec<usize>>, count: usize) -> Vec<Vec<usize>> {
        let weighted = |column: &&[f64]| self.weights.iter().zip(*column).map(|(w, x)| w * x).collect();
        let weighted: Vec<Vec<f64>> = columns.iter().map(weighted).collect();
        let along: Vec<f64> = weighted.iter().map(|column| product(column, &self.rest)).collect();
        let gain = |set: &[usize]| match *set {
            [k] => along[k] * along[k],
            [k, l] => {
                let angle = product(&weighted[k], columns[l]);
                let across = 1.0 - angle * angle;
                let both = along[k] * along[k] + along[l] * along[l] - 2.0 * angle * along[k] * along[l];
                if across > DEPENDENT { both / across } else { 0.0 }
            }
            _ => 0.0,
        };
        let mut sets: Vec<(f64, Vec<usize>)> = sets.into_iter().map(|set| (gain(&set), set)).collect();
        sets.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
        sets.into_iter().take(count).map(|(_, set)| set).collect()
    }

    /// Rounds of Lawson's for the basis and columns across it: the one with the smallest largest
    /// residual. None where the least squares have no solution, or two rounds leave more than a limit.
    pub fn lawson(&self, others: &[&[f64]], rounds: usize, limit: f64) -> Option<Level> {
        let columns: Vec<&[f64]> =
            self.basis.iter().map(Vec::as_slice).chain(others.iter().copied()).collect();
        let mut weights = self.weights.clone();
        let mut best: Option<Level> = None;
        for round in 0..rounds {
            let residuals = self.residuals(&columns, &weights)?;
            let max = residuals.iter().fold(0.0_f64, |top, r| top.max(r.abs()));
            if best.as_ref().is_none_or(|level| max < level.max) {
                best = Some(Level { max, weights: weights.clone() });
            }
            if round == 1 && best.as_ref().is_some_and(|level| level.max > limit) {
                return None;
            }
            weights.iter_mut().zip(&residuals).for_each(|(w, r)| *w *= r.abs());
            let sum: f64 = weights.iter().sum();
            if !(sum.is_finite() && sum > 0.0) {
                break;
            }
            weights.iter_mut().for_each(|w| *w /= sum);
        }
        best
    }

    /// What the least squares under these weights leave. As the basis has parts of the target in
    /// itself, the rest stands for the target.
    fn residuals(&self, columns: &[&[f64]], weights: &[f64]) -> Option<Vec<f64>> {
        let n = columns.len();
        let mut squares = DMatrix::zeros(n, n);
        let mut sides = DVector::zeros(n);
        for (i, column) in columns.iter().enumerate() {
            let weighted: Vec<f64> = weights.iter().zip(*column).map(|(w, x)| w * x).collect();
            for (j, other) in columns[..=i].iter().enumerate() {
                squares[(i, j)] = product(&weighted, other);
                squares[(j, i)] = squares[(i, j)];
            }
            sides[i] = product(&weighted, &self.rest);
        }
        let coefficients = squares.cholesky()?.solve(&sides);
        let mut residuals = self.rest.clone();
        for (column, c) in columns.iter().zip(&coefficients) {
            take(&mut residuals, *c, column);
        }
        Some(residuals)
    }
}

/// The coefficients of columns, by least squares under weights.
pub(super) fn coefficients(columns: &[Vec<f64>], target: &[f64], weights: &[f64]) -> Option<Vec<f64>> {
    let rows = target.len();
    let root: Vec<f64> = weights.iter().map(|w| w.sqrt()).collect();
    let matrix = DMatrix::from_fn(rows, columns.len(), |i, j| root[i] * columns[j][i]);
    let side = DVector::from_fn(rows, |i, _| root[i] * target[i]);
    let qr = matrix.qr();
    let solved = qr.r().solve_upper_triangular(&(qr.q().transpose() * side))?;
    solved.iter().all(|c| c.is_finite()).then(|| solved.iter().copied().collect())
}

fn dot(weights: &[f64], a: &[f64], b: &[f64]) -> f64 {
    weights.iter().zip(a).zip(b).map(|((w, a), b)| w * a * b).sum()
}

/// Takes so much of a column away. Every form of it does the same operations in the same order.
#[multiversion(targets("x86_64+avx+avx2"))]
fn take(from: &mut [f64], along: f64, column: &[f64]) {
    from.iter_mut().zip(column).for_each(|(x, q)| *x -= along * q);
}

/// The sum of products, in eight sums side by side: one sum waits for every addition. Every form of it does
/// the same operations in the same order.
#[multiversion(targets("x86_64+avx+avx2"))]
fn product(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (left, right) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = left.remainder().iter().zip(right.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in left.zip(right) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    rest + sums.iter().sum::<f64>()
}
