//! Least squares over walls, by their normal equations.

use lobefit_fit::{Halt, Limits, Squares, Triangle};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::quantity::footprint::slant::Normal;

/// Where a search ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Least {
    /// The parameters.
    pub at: Vec<f64>,
    /// The sum of squares.
    pub value: f64,
    /// That of the start.
    pub start: f64,
    /// Whether nothing near is lower, not the iterations ran out.
    pub settled: bool,
}

/// An evaluation makes as many footprints as there are walls. No parameter moves farther than 1/2
/// in a step: widths and weights are logarithms, tilts multiples of the lobe's width. A step that
/// gains less than 1e-7 ends the search.
const LIMITS: Limits = Limits { iterations: 0, trials: 14, longest: 0.5, settled: Some(1e-7) };

/// Minimises a sum of squares from a start; `squares` gives none where its parameters are refused.
/// Deterministic.
///
/// # Errors
/// A start that is refused; equations that are those of no sum of squares.
pub fn least<F>(squares: F, start: &[f64], iterations: u64) -> Result<Least, IntegrateError>
where
    F: Fn(&[f64]) -> Option<Normal>,
{
    let found = lobefit_fit::least(&Walls(squares), start, Limits { iterations, ..LIMITS });
    let found = found.map_err(|error| IntegrateError::Search {
        quantity: "slanted footprint",
        start: start.to_vec(),
        reason: error.to_string(),
    })?;
    let settled = found.halt != Halt::Cap;
    Ok(Least { at: found.at, value: found.value, start: found.start, settled })
}

struct Walls<F>(F);

/// The model of normal equations, and their sum of squares.
struct Local {
    triangle: Triangle,
    value: f64,
}

impl<F: Fn(&[f64]) -> Option<Normal>> Squares for Walls<F> {
    type Point = Normal;
    type Model = Local;

    fn point(&self, at: &[f64]) -> Option<Normal> {
        (self.0)(at)
    }

    fn value(&self, normal: &Normal) -> f64 {
        normal.value
    }

    fn model(&self, _: &[f64], normal: &Normal) -> Result<Local, String> {
        let triangle = Triangle::of_products(normal.value, &normal.gradient, &normal.hessian);
        let triangle = triangle.ok_or("the normal equations are those of no sum of squares")?;
        Ok(Local { triangle, value: normal.value })
    }

    fn triangle<'a>(&self, local: &'a Local) -> &'a Triangle {
        &local.triangle
    }

    fn gain(&self, local: &Local, to: &Normal, step: &[f64]) -> (f64, f64) {
        (local.value - to.value, local.value - local.triangle.predicted(step))
    }

    fn is_zero(&self, local: &Local) -> bool {
        local.value == 0.0
    }
}
