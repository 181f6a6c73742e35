//! The normal equations of a sum of squares: of many walls' residuals there is no room for the
//! Jacobian.

use nalgebra::{DMatrix, DVector};

/// A sum of squares with half its gradient and its Gauss-Newton Hessian.
#[derive(Clone, Debug)]
pub struct Normal {
    /// |r|^2.
    pub value: f64,
    /// J^T r.
    pub gradient: DVector<f64>,
    /// J^T J.
    pub hessian: DMatrix<f64>,
}

impl Normal {
    /// Of residuals and the columns of their Jacobian; `None` if a number is none.
    pub fn of(residuals: &[f64], columns: &[Vec<f64>]) -> Option<Normal> {
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let gradient = DVector::from_iterator(columns.len(), columns.iter().map(|c| product(c, residuals)));
        let mut hessian = DMatrix::zeros(columns.len(), columns.len());
        for (i, a) in columns.iter().enumerate() {
            for (j, b) in columns[..=i].iter().enumerate() {
                let value = product(a, b);
                (hessian[(i, j)], hessian[(j, i)]) = (value, value);
            }
        }
        Normal { value: product(residuals, residuals), gradient, hessian }.finite()
    }

    /// Itself, if all of it is finite.
    pub fn finite(self) -> Option<Normal> {
        let parts = self.gradient.iter().chain(self.hessian.iter()).all(|x| x.is_finite());
        (parts && self.value.is_finite()).then_some(self)
    }

    /// Adds `weight` times a sum of squares of other parameters, whose derivatives by these are
    /// `by`.
    pub fn add(&mut self, weight: f64, other: &Normal, by: &DMatrix<f64>) {
        self.value += weight * other.value;
        self.gradient += by.tr_mul(&other.gradient) * weight;
        self.hessian += by.tr_mul(&(&other.hessian * by)) * weight;
    }
}
