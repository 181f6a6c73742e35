//! The truth of a factor over a grid of roughness and mu: what the page of the effect is drawn
//! from.

use crate::data::Smith;
use crate::effects::Albedo;
use crate::effects::context::Context;
use crate::effects::grid::Grid;
use lobefit_truth::integrate::{Estimate, IntegrateError};
use lobefit_truth::quantity::TRUTH_ERROR;
use lobefit_truth::quantity::coupling::{Specular, Split, factor};

/// A grid with E and B.
pub struct Factors {
    pub grid: Grid,
    truth: Albedo,
}

impl Factors {
    /// The truth over a grid.
    pub fn new(smith: Smith, grid: Grid, context: &Context) -> Result<Factors, IntegrateError> {
        let truth = Albedo::new(smith, &grid.points, true, &context.memo)?;
        Ok(Factors { grid, truth })
    }

    /// The true factor at every point.
    pub fn at(&self, specular: Specular, f0: f64) -> Vec<f64> {
        let one = |(e, b): (&f64, &f64)| {
            let with = |value| Estimate { value, error: TRUTH_ERROR };
            factor(&Split { e: with(*e), a: with(e - b), loss: with(1.0 - e) }, f0, specular).value
        };
        self.truth.e.iter().zip(&self.truth.b).map(one).collect()
    }
}
