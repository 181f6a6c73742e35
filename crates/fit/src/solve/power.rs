//! The norm (mean |r|^p)^(1/p), and its quadratic model.
//!
//! With w = |r|^(p-2), the sum of |r + J d|^p is, to second order in d, p (p-1)/2 times the sum of
//! w (J d + r/(p-1))^2 and a constant: a least-squares problem with weights, so that one solver,
//! Levenberg-Marquardt, serves every p >= 2.

use super::objective::{Linear, largest, rms};
use super::reduce::{Triangle, reduce};
use lobefit_math::ops::pow;

/// A p-norm, p >= 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PNorm(pub f64);

/// The model of the sum of powers at a point.
pub(super) struct Model {
    pub triangle: Triangle,
    /// What residuals are measured in, so that no power overflows or vanishes.
    unit: f64,
    /// Sum of powers at the point.
    level: f64,
    samples: f64,
}

impl PNorm {
    /// Least squares.
    pub const SQUARE: PNorm = PNorm(2.0);

    /// Its value: at most the largest residual, at least the root mean square.
    pub fn of(self, residuals: &[f64]) -> f64 {
        if self == PNorm::SQUARE {
            return rms(residuals);
        }
        let unit = largest(residuals);
        if unit == 0.0 {
            return 0.0;
        }
        unit * pow(self.level(residuals, unit) / residuals.len() as f64, 1.0 / self.0)
    }

    /// Sum of (|r|/unit)^p, by runs.
    fn level(self, residuals: &[f64], unit: f64) -> f64 {
        let power = |r: &f64| {
            let ratio = r.abs() / unit;
            if self == PNorm::SQUARE { ratio * ratio } else { pow(ratio, self.0) }
        };
        residuals.chunks(4096).map(|run| run.iter().map(power).sum::<f64>()).sum()
    }

    pub fn model(self, linear: &Linear) -> Model {
        if self == PNorm::SQUARE {
            let length = linear.triangle.residual_norm();
            let (triangle, samples) = (linear.triangle.clone(), linear.residuals.len() as f64);
            return Model { triangle, unit: 1.0, level: length * length, samples };
        }
        self.scaled_model(linear)
    }

    /// The model in units of the largest residual, whatever the power.
    pub fn scaled_model(self, linear: &Linear) -> Model {
        let unit = largest(&linear.residuals).max(f64::MIN_POSITIVE);
        let n = linear.triangle.r.ncols();
        let root = |r: &f64| pow(r.abs() / unit, 0.5 * self.0 - 1.0) / unit;
        let roots: Vec<f64> = linear.residuals.iter().map(root).collect();
        let pairs = linear.residuals.iter().zip(&roots);
        let residuals: Vec<f64> = pairs.map(|(r, root)| root * r / (self.0 - 1.0)).collect();
        let weighted = |(i, x): (usize, &f64)| roots[i / n] * x;
        let jacobian: Vec<f64> = linear.jacobian.iter().enumerate().map(weighted).collect();
        let level = self.level(&linear.residuals, unit);
        let samples = residuals.len() as f64;
        Model { triangle: reduce(&jacobian, &residuals, n), unit, level, samples }
    }

    /// What a step to `residuals` has gained, and what the model promised for it.
    pub fn gain(self, model: &Model, residuals: &[f64], step: &[f64]) -> (f64, f64) {
        let length = model.triangle.residual_norm();
        let promised = length * length - model.triangle.predicted(step);
        if self == PNorm::SQUARE {
            let rms = rms(residuals);
            return (model.level - rms * rms * residuals.len() as f64, promised);
        }
        (model.level - self.level(residuals, model.unit), 0.5 * self.0 * (self.0 - 1.0) * promised)
    }

    /// unit * mean of (|r|/unit)^p: a measure in the units of residuals, whatever the power. Of a
    /// scaled model.
    pub fn mean_power(self, model: &Model, residuals: &[f64]) -> f64 {
        model.unit * self.level(residuals, model.unit) / model.samples
    }

    /// [`PNorm::mean_power`] after a step, by the scaled model.
    pub fn predicted(self, model: &Model, step: &[f64]) -> f64 {
        let length = model.triangle.residual_norm();
        let gained = 0.5 * self.0 * (self.0 - 1.0) * (length * length - model.triangle.predicted(step));
        model.unit * (model.level - gained) / model.samples
    }

    /// Factor of |R d + q|^2 in the mean power.
    pub fn curvature(self, model: &Model) -> f64 {
        0.5 * self.0 * (self.0 - 1.0) * model.unit / model.samples
    }
}
