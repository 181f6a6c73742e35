//! The truth over roughness and mu at some slices: what pictures are drawn from.

use super::{Judged, Lookup, LookupError, LookupPoints, Region, Sliced, Truth, error_map};
use crate::approximate::Memo;
use crate::data::Smith;
use crate::effects::{BakeError, grid};
use crate::report::Field;
use lobefit_truth::integrate::glass::Side;

/// The truth on the grid of one slice.
pub struct Grid {
    /// The slice input.
    pub slice: f64,
    /// Roughness and mu.
    over: grid::Grid,
    points: LookupPoints,
    truths: Vec<Vec<f64>>,
}

impl Grid {
    /// A grid per slice.
    pub fn all<F: Sliced>(
        family: &F,
        (smith, region): (Smith, &Region),
        over: &grid::Grid,
        slices: &[f64],
    ) -> Result<Vec<Grid>, BakeError> {
        let grid = |slice: &f64| {
            let points = LookupPoints::grid(region, &over.roughness.values, &over.mu.values, *slice);
            let truths = family.truths(smith, &points, false, &Memo::default())?;
            let truths = truths.sides.into_iter().map(|side| side.e).collect();
            Ok(Grid { slice: *slice, over: over.clone(), points, truths })
        };
        slices.iter().map(grid).collect()
    }

    fn truth(&self, side: Option<Side>) -> &[f64] {
        &self.truths[usize::from(side == Some(Side::Inside))]
    }

    /// The truth as a picture.
    pub fn albedo(&self, name: &str, side: Option<Side>) -> Field {
        self.over.field(name, false, self.truth(side).iter().copied())
    }

    /// Signed errors of a lookup as a picture.
    pub fn errors(&self, name: &str, lookup: &Lookup, side: Option<Side>) -> Result<Field, LookupError> {
        let truth = Truth { e: self.truth(side), b: None };
        let errors = error_map(lookup, Judged::E, &self.points, truth)?;
        Ok(self.over.field(name, true, errors.into_iter()))
    }

    /// E over mu, by roughness.
    pub fn furnace(&self, side: Option<Side>) -> Vec<Vec<f64>> {
        self.over.by_roughness(self.truth(side))
    }

    /// E / lookup over mu, by roughness.
    pub fn compensated(&self, lookup: &Lookup, side: Option<Side>) -> Vec<Vec<f64>> {
        let pairs = self.points.all.iter().zip(self.truth(side));
        let factors: Vec<f64> = pairs.map(|(point, e)| e / f64::from(lookup.at(point).e)).collect();
        self.over.by_roughness(&factors)
    }
}
