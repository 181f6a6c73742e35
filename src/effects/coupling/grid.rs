//! The truth of a factor, and fits of it, over a grid of roughness and mu: what the page of the effect is drawn from.

use crate::approximate::{Field as Truth, Fit, FitStageError, PointSet, Region, TRUTH_ERROR};
use crate::data::Smith;
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::report::{Field, FitCurve, Ruler};
use lobefit_truth::integrate::Estimate;
use lobefit_truth::integrate::coupling::{Specular, Split, factor};

/// A grid, mu along rows, with E and B.
pub struct Grid {
    pub roughness: Ruler,
    pub mu: Ruler,
    points: PointSet,
    truth: Truth,
}

impl Grid {
    /// The truth over two rulers.
    pub fn new(smith: Smith, region: &Region, roughness: Ruler, mu: Ruler, context: &Context) -> Grid {
        let mut points = PointSet::default();
        for m in &mu.values {
            for r in &roughness.values {
                points.push(region, *r, *m);
            }
        }
        let truth = Truth::split(smith, &points, &context.counter);
        Grid { roughness, mu, points, truth }
    }

    /// The true factor at every point.
    pub fn factors(&self, specular: Specular, f0: f64) -> Vec<f64> {
        let one = |(e, b): (&f64, &f64)| {
            let with = |value| Estimate { value, error: TRUTH_ERROR };
            factor(&Split { e: with(*e), a: with(e - b), loss: with(1.0 - e) }, f0, specular).value
        };
        self.truth.e.iter().zip(&self.truth.b).map(one).collect()
    }

    /// A formula at every point.
    pub fn values(&self, fit: &Fit, f0: f64) -> Result<Vec<f64>, BakeError> {
        let values = fit.values_for(&self.points, f0 as f32).map_err(FitStageError::from)?;
        Ok(values.into_iter().map(f64::from).collect())
    }

    /// A field over the grid, roughness along x and mu along y.
    pub fn field(&self, name: &str, signed: bool, values: impl Iterator<Item = f64>) -> Field {
        Field {
            name: name.into(),
            unit: String::new(),
            signed,
            x: self.roughness.clone(),
            y: self.mu.clone(),
            values: values.map(|v| v as f32).collect(),
        }
    }

    /// Values at every point as one list over mu for each roughness.
    pub fn by_roughness(&self, values: &[f64]) -> Vec<Vec<f64>> {
        let columns = self.roughness.values.len();
        (0..columns).map(|k| values.iter().skip(k).step_by(columns).copied().collect()).collect()
    }

    /// A factor and its fit over mu, one for each roughness.
    pub fn curves(&self, fit: &Fit, specular: Specular, f0: f64) -> Result<Vec<FitCurve>, BakeError> {
        let truth = self.by_roughness(&self.factors(specular, f0));
        let values = self.by_roughness(&self.values(fit, f0)?);
        let pairs = self.roughness.values.iter().zip(truth.into_iter().zip(values));
        let curve = |(roughness, (truth, fit)): (&f64, (Vec<f64>, Vec<f64>))| FitCurve {
            roughness: *roughness,
            mu: self.mu.values.clone(),
            truth,
            fit,
        };
        Ok(pairs.map(curve).collect())
    }
}
