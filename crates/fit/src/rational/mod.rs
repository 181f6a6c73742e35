//! Globally optimal minimax of linear and rational forms: linear programs with differential
//! correction.
//!
//! Of a residual scale n(p)/d(p) - target whose n and d are affine in the coefficients p, the set
//! of p with every residual below a level t is a polyhedron: |scale n - target d| <= t d. From a
//! level and its coefficients a linear program finds better ones, or proves that there are none
//! (Barrodale, Powell and Roberts, "The differential correction algorithm for rational l-infinity
//! approximation", 1972); the levels converge quadratically. No search over starts, no local
//! minimum: what is returned is the best on these samples, within the gap that is returned with it.

mod columns;
mod descent;
mod level;
mod simplex;

use super::{FitError, Termination};
pub(super) use columns::Columns;
pub(super) use descent::Descent;
use lobefit_shade::ShadeError;

/// Residuals scale_i n_i(p)/d_i(p) - target_i, one per sample, with n and d affine in the
/// coefficients p.
///
/// A linear form has the denominator 1: a row 1, 0, 0, ...
#[derive(Clone, Debug, PartialEq)]
pub struct Rational {
    /// Number of coefficients.
    pub parameters: usize,
    /// Row by row, `1 + parameters` per sample: the constant term, then the factor of each
    /// coefficient.
    pub numerator: Vec<f64>,
    /// The same of the denominator.
    pub denominator: Vec<f64>,
    /// Factor of the quotient, one per sample.
    pub scale: Vec<f64>,
    /// What the product should be, one per sample.
    pub target: Vec<f64>,
}

/// A constraint on the coefficients: `coefficients . p <= bound`, or `=` if `equal`.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// One per coefficient.
    pub coefficients: Vec<f64>,
    /// Right side.
    pub bound: f64,
    /// Whether the two sides must be equal.
    pub equal: bool,
}

/// The best coefficients of a [`Rational`], and the proof of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Optimum {
    /// The coefficients.
    pub coefficients: Vec<f64>,
    /// Largest residual over the samples.
    pub max: f64,
    /// No admissible coefficients have a smaller largest residual than this on these samples: a
    /// linear program's multipliers prove it, to rounding. Admissible are those that keep the rows,
    /// whose denominators are positive (at least 1e-7 of the largest entry of their sample's row),
    /// and which lie within 1e13 when every column is scaled to a largest entry of 1.
    pub bound: f64,
    /// (max - bound) / max; 0 if max is 0.
    pub gap: f64,
    /// Linear programs solved.
    pub programs: usize,
    /// [`Termination::Minimax`] (gap at most 1e-4), [`Termination::ZeroResidual`],
    /// [`Termination::NoParameters`], [`Termination::TooFewSamples`] (fewer samples than
    /// coefficients: a form that passes through all of them is found), [`Termination::Stalled`]
    /// (the programs found nothing better, the gap is larger) or [`Termination::IterationCap`].
    pub termination: Termination,
}

/// Best coefficients in the sense of the largest residual. Deterministic, single-threaded.
///
/// `start`, where given, only saves programs: the result does not depend on it beyond rounding.
///
/// # Errors
/// Shapes that do not fit, numbers that are not finite ([`ShadeError::Shape`],
/// [`ShadeError::NotFinite`]); no coefficients with positive denominators
/// ([`FitError::NoDenominator`]); rows that contradict one another or the denominators
/// ([`FitError::Infeasible`]); a coefficient that others can replace ([`FitError::Degenerate`]); a
/// program that fails in floating point ([`FitError::Solver`]).
pub fn minimax(problem: &Rational, rows: &[Row], start: Option<&[f64]>) -> Result<Optimum, FitError> {
    let columns = Columns::new(problem)?;
    check_rows(problem.parameters, rows)?;
    if let Some(start) = start
        && start.len() != problem.parameters
    {
        let what = "starting coefficients".to_string();
        return Err(ShadeError::Shape { what, found: start.len(), expected: problem.parameters }.into());
    }
    let few = columns.samples < problem.parameters;
    if !few && let Some(parameter) = columns.dependent() {
        return Err(FitError::Degenerate { parameter });
    }
    let mut descent = Descent::new(&columns, rows, start)?;
    descent.run()?;
    let mut optimum = descent.prove()?;
    if few {
        optimum.termination = Termination::TooFewSamples;
    }
    Ok(optimum)
}

fn check_rows(parameters: usize, rows: &[Row]) -> Result<(), FitError> {
    for (index, row) in rows.iter().enumerate() {
        if row.coefficients.len() != parameters {
            let what = format!("coefficients of row {index}");
            return Err(
                ShadeError::Shape { what, found: row.coefficients.len(), expected: parameters }.into()
            );
        }
        let numbers = row.coefficients.iter().chain([&row.bound]);
        if let Some(value) = numbers.copied().find(|v| !v.is_finite()) {
            return Err(ShadeError::NotFinite { column: "row".to_string(), index, value }.into());
        }
    }
    Ok(())
}
