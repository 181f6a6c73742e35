//! Orthogonal reduction of a tall Jacobian to a small triangle: everything that least squares
//! needs, without ever forming normal equations (which square the condition number).

use multiversion::multiversion;
use nalgebra::{ColPivQR, DMatrix, DVector, Dyn, SymmetricEigen};
use rayon::prelude::*;

use lobefit_math::lanes::{self, LANES};

/// Rows reduced together.
const CHUNK: usize = 1024;

/// A singular value below this part of the largest counts as zero.
pub(super) const RANK_TOLERANCE: f64 = 1e-11;

/// The triangular factor of [J | r]: |J d + r|^2 = |R d + q|^2 + rest^2 for every d.
#[derive(Clone, Debug)]
pub struct Triangle {
    /// R, n x n.
    pub(super) r: DMatrix<f64>,
    /// The first n components of r in the basis of J.
    pub(super) q: DVector<f64>,
    /// What no d can remove.
    pub(super) rest: f64,
}

/// Reduces a Jacobian of n columns, given row by row, and its residuals.
pub(super) fn reduce(jacobian: &[f64], residuals: &[f64], n: usize) -> Triangle {
    let width = n + 1;
    let parts: Vec<Vec<f64>> = residuals
        .par_chunks(CHUNK)
        .enumerate()
        .map(|(chunk, residuals)| {
            let rows = &jacobian[chunk * CHUNK * n..(chunk * CHUNK + residuals.len()) * n];
            let mut columns = Vec::with_capacity(residuals.len() * width);
            for j in 0..n {
                columns.extend(rows.iter().skip(j).step_by(n));
            }
            columns.extend_from_slice(residuals);
            triangularise(columns, width)
        })
        .collect();
    let column =
        |j| parts.iter().flat_map(move |part| part.chunks_exact(part.len() / width).nth(j)).flatten();
    let stacked = triangularise((0..width).flat_map(column).copied().collect(), width);
    let height = stacked.len() / width;
    let at = |i: usize, j: usize| if i < height { stacked[j * height + i] } else { 0.0 };
    Triangle {
        r: DMatrix::from_fn(n, n, |i, j| if j >= i { at(i, j) } else { 0.0 }),
        q: DVector::from_fn(n, |i, _| at(i, n)),
        rest: at(n, n).abs(),
    }
}

/// The triangular factor, `width` rows or fewer, of a matrix given column by column (Householder
/// reflections). Every form of it does the same operations in the same order.
#[multiversion(targets("x86_64+avx+avx2"))]
fn triangularise(mut a: Vec<f64>, width: usize) -> Vec<f64> {
    let rows = a.len() / width;
    let height = width.min(rows);
    for k in 0..height {
        let (left, right) = a.split_at_mut((k + 1) * rows);
        let v = &mut left[k * rows + k..];
        let norm = dot(v, v).sqrt();
        if norm == 0.0 {
            continue;
        }
        let pivot = v[0];
        let alpha = if pivot > 0.0 { -norm } else { norm };
        // v = x - alpha e_k; |v|^2 / 2 = norm (norm + |pivot|)
        let half = norm * (norm + pivot.abs());
        v[0] -= alpha;
        for column in right.chunks_exact_mut(rows) {
            let x = &mut column[k..];
            let along = dot(v, x) / half;
            for (x, v) in x.iter_mut().zip(v.iter()) {
                *x -= along * v;
            }
        }
        v.fill(0.0);
        v[0] = alpha;
    }
    a.chunks_exact(rows.max(1)).flat_map(|column| &column[..height]).copied().collect()
}

/// The scalar product, summed in lanes.
#[inline(always)]
fn dot(x: &[f64], y: &[f64]) -> f64 {
    let ((x, x_rest), (y, y_rest)) = (x.as_chunks::<LANES>(), y.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for (x, y) in x.iter().zip(y) {
        for i in 0..LANES {
            sums[i] += x[i] * y[i];
        }
    }
    lanes::sum(&sums) + x_rest.iter().zip(y_rest).map(|(x, y)| x * y).sum::<f64>()
}

/// Eigenvalues of normal equations with a unit diagonal below this are rounding: their square roots
/// are below 1e-6.
const NO_CURVATURE: f64 = 1e-12;

impl Triangle {
    /// A factor from normal equations |r|^2, J^T r and J^T J, where the rows of J are too many to
    /// keep: half the digits of `reduce`, and square instead of triangular. `None` where they are
    /// those of no sum of squares.
    pub fn of_products(square: f64, gradient: &DVector<f64>, hessian: &DMatrix<f64>) -> Option<Triangle> {
        let n = gradient.len();
        let lengths: Vec<f64> = hessian.diagonal().iter().map(|d| d.sqrt()).collect();
        let over = |i: usize| if lengths[i] > 0.0 { 1.0 / lengths[i] } else { 0.0 };
        let eigen = SymmetricEigen::new(DMatrix::from_fn(n, n, |i, j| over(i) * hessian[(i, j)] * over(j)));
        let bad = |x: &f64| x.is_nan() || *x < -NO_CURVATURE * n as f64;
        if lengths.iter().any(|x| !x.is_finite()) || eigen.eigenvalues.iter().any(bad) {
            return None;
        }
        let root = |k: usize| eigen.eigenvalues[k].max(0.0).sqrt();
        let along =
            |k: usize| (0..n).map(|i| eigen.eigenvectors[(i, k)] * over(i) * gradient[i]).sum::<f64>();
        let q =
            DVector::from_fn(
                n,
                |k, _| {
                    if eigen.eigenvalues[k] > NO_CURVATURE { along(k) / root(k) } else { 0.0 }
                },
            );
        let r = DMatrix::from_fn(n, n, |k, j| root(k) * eigen.eigenvectors[(j, k)] * lengths[j]);
        let rest = (square - q.norm_squared()).max(0.0).sqrt();
        Some(Triangle { r, q, rest })
    }

    /// Whether all of it is a finite number.
    pub fn is_finite(&self) -> bool {
        self.r.iter().chain(&self.q).chain([&self.rest]).all(|x| x.is_finite())
    }

    /// Length of each column of the Jacobian.
    pub fn column_norms(&self) -> Vec<f64> {
        self.r.column_iter().map(|c| c.norm()).collect()
    }

    /// Length of the residuals.
    pub fn residual_norm(&self) -> f64 {
        (self.q.norm_squared() + self.rest * self.rest).sqrt()
    }

    /// Largest cosine between the residuals and a column of the Jacobian: 0 at a minimum (Moré
    /// 1978, eq. 5.2).
    pub fn orthogonality(&self) -> f64 {
        let length = self.residual_norm();
        let cosine = |j: usize| {
            let column = self.r.column(j);
            let size = column.norm() * length;
            if size > 0.0 { column.dot(&self.q).abs() / size } else { 0.0 }
        };
        (0..self.r.ncols()).map(cosine).fold(0.0, f64::max)
    }

    /// R with its columns scaled to length 1; those that are 0 stay 0.
    pub fn scaled(&self) -> DMatrix<f64> {
        let norms = self.column_norms();
        DMatrix::from_fn(self.r.nrows(), self.r.ncols(), |i, j| {
            if norms[j] > 0.0 { self.r[(i, j)] / norms[j] } else { 0.0 }
        })
    }

    /// The Jacobian's rank, its columns scaled to length 1.
    pub fn rank(&self) -> usize {
        if self.r.is_empty() {
            return 0;
        }
        let values = self.scaled().singular_values();
        let largest = values.iter().copied().fold(0.0, f64::max);
        values.iter().filter(|v| **v > RANK_TOLERANCE * largest).count()
    }

    /// The step d that minimises |R d + q|^2 + damping |D d|^2, D = diag(scale), by QR with column
    /// pivoting; 0 for a parameter of scale 0, which does not matter. None if it is not finite.
    pub fn step(&self, scale: &[f64], damping: f64) -> Option<Vec<f64>> {
        let n = self.r.ncols();
        let root = damping.sqrt();
        let augmented = DMatrix::from_fn(2 * n, n, |i, j| match (i < n, i == j + n) {
            (true, _) if scale[j] > 0.0 => self.r[(i, j)] / scale[j],
            (true, _) => 0.0,
            (_, true) => root,
            _ => 0.0,
        });
        let mut right = DVector::from_fn(2 * n, |i, _| if i < n { -self.q[i] } else { 0.0 });
        let qr: ColPivQR<f64, Dyn, Dyn> = ColPivQR::new(augmented);
        qr.q_tr_mul(&mut right);
        let mut z = qr.r().solve_upper_triangular(&right.rows(0, n))?;
        qr.p().inv_permute_rows(&mut z);
        let step: Vec<f64> = z.iter().zip(scale).map(|(z, s)| if *s > 0.0 { z / s } else { 0.0 }).collect();
        step.iter().all(|x| x.is_finite()).then_some(step)
    }

    /// |R d + q|^2 + rest^2: the square length of the residuals that the linear model predicts.
    pub fn predicted(&self, step: &[f64]) -> f64 {
        let moved = &self.r * DVector::from_column_slice(step) + &self.q;
        moved.norm_squared() + self.rest * self.rest
    }
}
