//! A weight of the errors that are minimised.

use super::FittingError;
use crate::perceptual::Perceptual;
use lobefit::approximate::place;
use lobefit::approximate::target::{Sampled, Target};
use lobefit_shade::{Hypothesis, Op, ShadeError};

/// What the errors are multiplied with.
#[derive(Clone, Debug)]
pub(super) enum Weight {
    /// A WGSL expression of a target's inputs.
    Expression(Box<Expression>),
    /// How much of an error is seen.
    Perceptual(Perceptual),
}

/// A WGSL expression of a target's inputs.
#[derive(Clone, Debug)]
pub(super) struct Expression {
    text: String,
    function: Hypothesis,
    inputs: Vec<String>,
}

/// The word for [`Perceptual`] in the place of an expression.
pub(super) const PERCEPTUAL: &str = "perceptual";

/// The input that it weighs by.
const MU: &str = "mu";

/// How the expression is named in messages of the front end.
const FILE: &str = "weight";

/// What stands before the expression on its line.
const BEFORE: &str = "return ";

impl Weight {
    /// Parses the expression as the body of a function of all inputs; `perceptual` stands for
    /// itself.
    pub fn parse(expression: &str, target: &Target) -> Result<Weight, FittingError> {
        if expression.trim() != PERCEPTUAL {
            return Ok(Weight::Expression(Box::new(Expression::parse(expression, target)?)));
        }
        if !target.inputs().iter().any(|input| input == MU) {
            return Err(FittingError::Weight {
                expression: expression.into(),
                reason: format!(
                    "weighs by mu, which is no input of {}; give an expression of its inputs, which are {}",
                    target.quantity.name(),
                    target.inputs().join(", ")
                ),
            });
        }
        Ok(Weight::Perceptual(Perceptual::new()))
    }

    /// Whether it has this input.
    pub fn reads(&self, input: &str) -> bool {
        match self {
            Weight::Expression(expression) => expression.reads(input),
            Weight::Perceptual(_) => input == MU,
        }
    }

    /// The weights of samples, in f64.
    pub fn of(&self, sampled: &Sampled) -> Result<Vec<f64>, FittingError> {
        match self {
            Weight::Expression(expression) => expression.of(sampled),
            Weight::Perceptual(weight) => {
                let mu = sampled.inputs(PERCEPTUAL, &[MU.to_string()])?;
                Ok(mu.iter().flatten().map(|mu| weight.at(f64::from(*mu))).collect())
            }
        }
    }
}

impl Expression {
    fn parse(expression: &str, target: &Target) -> Result<Expression, FittingError> {
        let refuse = |reason: String| FittingError::Weight { expression: expression.into(), reason };
        if expression.trim().is_empty() {
            return Err(refuse(
                "is empty; give a WGSL expression, such as `mu` or `1.0 / (0.1 + alpha)`".into(),
            ));
        }
        if expression.contains(['{', '}', ';', '\n']) {
            return Err(refuse(
                "one WGSL expression is called for, such as `mu` or `1.0 / (0.1 + alpha)`".into(),
            ));
        }
        let inputs = target.inputs();
        let arguments: Vec<String> = inputs.iter().map(|name| format!("{name}: f32")).collect();
        let source = format!("fn weight({}) -> f32 {{\n{BEFORE}{expression};\n}}\n", arguments.join(", "));
        let function = Hypothesis::parse(FILE, &source).map_err(|error| refuse(placed(&error)))?;
        Ok(Expression { text: expression.into(), function, inputs })
    }

    fn reads(&self, input: &str) -> bool {
        let tape = self.function.tape();
        tape.ops().iter().any(|op| matches!(op, Op::Input(i) if tape.inputs()[usize::from(*i)] == input))
    }

    fn of(&self, sampled: &Sampled) -> Result<Vec<f64>, FittingError> {
        let refuse = |reason: String| FittingError::Weight { expression: self.text.clone(), reason };
        let columns = sampled.inputs("weight", &self.inputs)?;
        let columns: Vec<Vec<f64>> =
            columns.into_iter().map(|c| c.into_iter().map(f64::from).collect()).collect();
        let mut weights = self.function.tape().evaluate(&columns, &[])?;
        // An expression without inputs has one value.
        if weights.len() == 1 {
            weights = vec![weights[0]; sampled.points.len()];
        }
        if let Some(i) = weights.iter().position(|w| !(w.is_finite() && *w >= 0.0)) {
            let at = lobefit::emit::header::place(&place(&sampled.points, i));
            return Err(refuse(format!(
                "is {} at {at}; a weight is a finite number, 0 or above",
                weights[i]
            )));
        }
        if weights.iter().all(|w| *w == 0.0) {
            return Err(refuse("is 0 everywhere: nothing is left to fit".into()));
        }
        Ok(weights)
    }
}

/// What the front end says, with the column of the expression itself.
fn placed(error: &ShadeError) -> String {
    match error {
        ShadeError::Syntax { place, message } | ShadeError::Dialect { place, message } => {
            format!("column {}: {message}", place.column.saturating_sub(BEFORE.len()).max(1))
        }
        other => other.to_string(),
    }
}
