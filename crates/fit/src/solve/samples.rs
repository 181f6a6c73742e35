//! What a formula is fitted to.

use crate::FitError;
use lobefit_shade::{ShadeError, Tape};

/// Residuals `scale f(inputs) - target`, one per sample.
///
/// The furnace error of a normalisation N has scale E and target 1; a fit of values has scale 1 and
/// the truth as target; weights multiply both.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// One column per input of the formula, in the order of its arguments.
    pub inputs: Vec<Vec<f64>>,
    /// Factor of the formula's value.
    pub scale: Vec<f64>,
    /// What the product should be.
    pub target: Vec<f64>,
}

/// An input in the digits of an f32 where it is one, as a shader has it; else in all of an f64's.
pub(super) fn digits(x: f64) -> String {
    if f64::from(x as f32) == x { (x as f32).to_string() } else { x.to_string() }
}

impl Samples {
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.target.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.target.is_empty()
    }

    /// Checks shapes against a formula, and that every datum is finite.
    pub(super) fn check(&self, tape: &Tape) -> Result<(), FitError> {
        let shape = |what: String, found, expected| Err(ShadeError::Shape { what, found, expected }.into());
        if self.is_empty() {
            return shape(format!("{}: samples", tape.function()), 0, 1);
        }
        if self.inputs.len() != tape.inputs().len() {
            let what = format!("{}: columns of inputs", tape.function());
            return shape(what, self.inputs.len(), tape.inputs().len());
        }
        let names = tape.inputs().iter().map(|name| format!("input {name}"));
        let columns = names.zip(&self.inputs);
        let rest = [("scale".to_string(), &self.scale), ("target".to_string(), &self.target)];
        for (name, column) in columns.chain(rest) {
            if column.len() != self.len() {
                return shape(format!("{}: samples of {name}", tape.function()), column.len(), self.len());
            }
            if let Some(index) = column.iter().position(|x| !x.is_finite()) {
                return Err(ShadeError::NotFinite { column: name, index, value: column[index] }.into());
            }
        }
        Ok(())
    }

    /// At most `count` of the samples, spread over all of them by the golden ratio.
    pub(super) fn subset(&self, count: usize) -> Samples {
        let all = self.len();
        if all <= count {
            return self.clone();
        }
        let mut picked: Vec<usize> = (0..count)
            .map(|i| {
                let u = (i as f64 + 0.5) * 0.618_033_988_749_894_9;
                (((u - u.floor()) * all as f64) as usize).min(all - 1)
            })
            .collect();
        picked.sort_unstable();
        picked.dedup();
        let pick = |column: &Vec<f64>| picked.iter().map(|&i| column[i]).collect();
        Samples {
            inputs: self.inputs.iter().map(pick).collect(),
            scale: pick(&self.scale),
            target: pick(&self.target),
        }
    }
}
