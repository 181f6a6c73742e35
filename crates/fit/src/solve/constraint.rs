//! What coefficients have to obey, whatever they minimise.

use crate::FitError;
use lobefit_shade::{ShadeError, Tape};

/// A condition on a formula, with the name that messages use.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    /// Its name, as the user wrote it: `exact at mu = 1`, ...
    pub name: String,
    /// What has to hold.
    pub condition: Condition,
}

/// What has to hold at given points: one column per input of the formula, in the order of its
/// arguments. It is asked of the formula's own value f, without the samples' scale and target.
#[derive(Clone, Debug, PartialEq)]
pub enum Condition {
    /// f = values.
    Equal {
        /// Where.
        points: Vec<Vec<f64>>,
        /// One value per point.
        values: Vec<f64>,
    },
    /// f >= values.
    AtLeast {
        /// Where.
        points: Vec<Vec<f64>>,
        /// One value per point.
        values: Vec<f64>,
    },
    /// f <= values.
    AtMost {
        /// Where.
        points: Vec<Vec<f64>>,
        /// One value per point.
        values: Vec<f64>,
    },
    /// f(from) <= f(to), pair by pair: monotone, in whichever direction the pairs point.
    Rising {
        /// Where f is to be lower or equal.
        from: Vec<Vec<f64>>,
        /// Where f is to be higher or equal.
        to: Vec<Vec<f64>>,
    },
}

impl Constraint {
    /// Number of points (or pairs of points).
    pub fn len(&self) -> usize {
        let (points, values) = self.condition.columns();
        values.map_or_else(|| points.first().map_or(0, Vec::len), <[f64]>::len)
    }

    /// Whether it asks for nothing.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Checks shapes against a formula, and that every number is finite.
    pub(super) fn check(&self, tape: &Tape) -> Result<(), FitError> {
        let (points, values) = self.condition.columns();
        self.check_columns(tape, points)?;
        if let Condition::Rising { to, .. } = &self.condition {
            self.check_columns(tape, to)?;
        }
        if let Some(values) = values {
            self.check_column("values", values)?;
        }
        Ok(())
    }

    fn check_columns(&self, tape: &Tape, points: &[Vec<f64>]) -> Result<(), FitError> {
        if points.len() != tape.inputs().len() {
            let what = format!("constraint `{}`: columns of inputs of {}", self.name, tape.function());
            return Err(ShadeError::Shape { what, found: points.len(), expected: tape.inputs().len() }.into());
        }
        let mut columns = tape.inputs().iter().zip(points);
        columns.try_for_each(|(name, column)| self.check_column(&format!("input {name}"), column))
    }

    fn check_column(&self, column: &str, values: &[f64]) -> Result<(), FitError> {
        let column = format!("constraint `{}`: {column}", self.name);
        if values.is_empty() || values.len() != self.len() {
            let what = format!("{column}: points");
            return Err(ShadeError::Shape { what, found: values.len(), expected: self.len().max(1) }.into());
        }
        match values.iter().position(|x| !x.is_finite()) {
            Some(index) => Err(ShadeError::NotFinite { column, index, value: values[index] }.into()),
            None => Ok(()),
        }
    }
}

impl Condition {
    /// Its points (the lower ones of pairs), and its values if it has any.
    pub(super) fn columns(&self) -> (&[Vec<f64>], Option<&[f64]>) {
        match self {
            Condition::Equal { points, values }
            | Condition::AtLeast { points, values }
            | Condition::AtMost { points, values } => (points, Some(values)),
            Condition::Rising { from, .. } => (from, None),
        }
    }
}
