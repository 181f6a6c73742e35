//! A formula with its coefficients, measured, and what a fit job gives.

use super::Safe;
use crate::data::{Approximation, Form};
use lobefit_shade::{Hypothesis, ShadeError};
use lobefit_truth::points::Points;

/// A formula with coefficients, measured.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The formula as an approximation.
    pub approximation: Approximation,
    /// The hypothesis that it is an instance of.
    pub hypothesis: Hypothesis,
    /// What it costs where formulas are compared: operations, or by the model of the vendor that the
    /// scene names.
    pub price: f64,
    /// Whether it is emitted, or only reported for comparison.
    pub emitted: bool,
    /// Whether it is the one to take of those that were fitted and emitted for one use.
    pub recommended: bool,
    /// Where it is proven to have no pole and no negative value, if that was asked for.
    pub safe: Option<Safe>,
}

/// A hypothesis without a fit: one of the catalogue whose search did not converge in this region or
/// into which a pole moves, or one of the user's that costs more than the scene allows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dropped {
    /// Hypothesis.
    pub hypothesis: String,
    /// Norm that was minimised.
    pub norm: &'static str,
    /// Why, in words.
    pub reason: String,
}

/// Everything that a fit job gives.
#[derive(Clone, Debug, Default)]
pub struct FitSet {
    /// Fits and published formulas.
    pub fits: Vec<Fit>,
    /// Hypotheses of the catalogue without a fit.
    pub dropped: Vec<Dropped>,
    /// Where no fit within the budget keeps the stated error: what does, in words.
    pub nearest: Option<String>,
    /// Functions for other uses that no formula within the limits gives: what does, in words.
    pub unserved: Vec<String>,
}

impl FitSet {
    /// That no formula gives a function within the limits, and the nearest.
    pub fn unkept(function: &str, nearest: &str) -> String {
        format!("{function}: no formula is within the limits: {nearest}")
    }
}

impl Fit {
    /// The norm that its coefficients minimise: `max`, `rms` or `published`.
    pub fn norm(&self) -> &str {
        match &self.approximation.form {
            Form::Formula(formula) => &formula.norm,
            Form::Table(_) => "",
        }
    }

    /// Its coefficients, in order.
    pub fn coefficients(&self) -> Vec<f32> {
        match &self.approximation.form {
            Form::Formula(formula) => formula.coefficients.iter().map(|(_, value)| *value).collect(),
            Form::Table(_) => Vec::new(),
        }
    }

    /// Its values in f32 at points; f0 = 1.
    pub fn values(&self, points: &Points) -> Result<Vec<f32>, ShadeError> {
        self.values_for(points, 1.0)
    }

    /// Its values in f32 at points, for one f0.
    pub fn values_for(&self, points: &Points, f0: f32) -> Result<Vec<f32>, ShadeError> {
        self.hypothesis.tape().evaluate(&self.columns(points, f0)?, &self.coefficients())
    }

    /// The columns of its inputs at points, for one f0.
    ///
    /// # Errors
    /// An input that the set does not have.
    pub fn columns(&self, points: &Points, f0: f32) -> Result<Vec<Vec<f32>>, ShadeError> {
        let column = |name: &String| match name.as_str() {
            "f0" => Ok(vec![f0; points.len()]),
            name => points.column_f32(name).ok_or_else(|| ShadeError::UnknownInput {
                function: self.hypothesis.name().into(),
                input: name.into(),
                given: "roughness, alpha, mu, f0".into(),
            }),
        };
        self.hypothesis.inputs().iter().map(column).collect()
    }
}
