//! The truth over roughness and mu at some slices: what pictures are drawn from.

use super::{Judged, Lookup, LookupError, Points, Region, Sliced, Truth, error_map};
use crate::data::Smith;
use crate::effects::BakeError;
use crate::report::{Field, Ruler};
use lobefit_truth::integrate::glass::Side;

/// The truth on one grid.
pub struct Grid {
    /// The slice input.
    pub slice: f64,
    /// Ruler of roughness.
    pub roughness: Ruler,
    /// Ruler of mu.
    pub mu: Ruler,
    points: Points,
    truths: Vec<Vec<f64>>,
}

impl Grid {
    /// A grid per slice.
    pub fn all<F: Sliced>(
        family: &F,
        (smith, region): (Smith, &Region),
        [roughness, mu]: [&Ruler; 2],
        slices: &[f64],
    ) -> Result<Vec<Grid>, BakeError> {
        let grid = |slice: &f64| {
            let points = Points::grid(region, &roughness.values, &mu.values, *slice);
            let truths = family.on_grid(smith, &points, roughness.values.len())?;
            Ok(Grid { slice: *slice, roughness: roughness.clone(), mu: mu.clone(), points, truths })
        };
        slices.iter().map(grid).collect()
    }

    fn truth(&self, side: Option<Side>) -> &[f64] {
        &self.truths[usize::from(side == Some(Side::Inside))]
    }

    /// The truth as a picture.
    pub fn albedo(&self, name: &str, side: Option<Side>) -> Field {
        self.field(name, false, self.truth(side).iter().copied())
    }

    /// Signed errors of a lookup as a picture.
    pub fn errors(&self, name: &str, lookup: &Lookup, side: Option<Side>) -> Result<Field, LookupError> {
        let truth = Truth { e: self.truth(side), b: None };
        let errors = error_map(lookup, Judged::E, &self.points, truth)?;
        Ok(self.field(name, true, errors.into_iter()))
    }

    fn field(&self, name: &str, signed: bool, values: impl Iterator<Item = f64>) -> Field {
        Field {
            name: name.into(),
            unit: String::new(),
            signed,
            x: self.roughness.clone(),
            y: self.mu.clone(),
            values: values.map(|v| v as f32).collect(),
        }
    }

    /// E over mu, by roughness.
    pub fn furnace(&self, side: Option<Side>) -> Vec<Vec<f64>> {
        self.columns(self.truth(side).to_vec())
    }

    /// E / lookup over mu, by roughness.
    pub fn compensated(&self, lookup: &Lookup, side: Option<Side>) -> Vec<Vec<f64>> {
        let pairs = self.points.all.iter().zip(self.truth(side));
        self.columns(pairs.map(|(point, e)| e / f64::from(lookup.at(point).e)).collect())
    }

    fn columns(&self, values: Vec<f64>) -> Vec<Vec<f64>> {
        let n = self.roughness.values.len();
        (0..n).map(|c| values.iter().skip(c).step_by(n).copied().collect()).collect()
    }
}

/// `n` cosines of a region, quadratically denser towards grazing.
pub fn grazing(region: &Region, n: usize) -> Ruler {
    let [low, high] = region.mu;
    let at = |i: usize| {
        let t = i as f64 / (n - 1) as f64;
        low + (high - low) * t * t
    };
    Ruler { name: "mu".into(), values: (0..n).map(at).collect() }
}
