//! The quantities by name: what `eval` asks for and gives.

use crate::data::Smith;
use crate::integrate::monte_carlo::{self, Draw, Points, Run};
use crate::integrate::{IntegrateError, reflection};

/// An input: its name and the closed interval of its values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input {
    /// Name of its column.
    pub name: &'static str,
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
}

/// A quantity that can be evaluated at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Its name.
    pub name: &'static str,
    /// Inputs, in the order that [`Quantity::evaluate`] takes them.
    pub inputs: &'static [Input],
    /// Outputs, in the order that it gives them; the last is the error.
    pub outputs: &'static [&'static str],
}

/// How a truth is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Quadrature to an absolute tolerance.
    Quadrature {
        /// Bound that `error` must meet.
        tolerance: f64,
    },
    /// Monte Carlo over visible normals with scrambled Sobol points; `error` is four standard errors.
    MonteCarlo {
        /// Samples a row.
        samples: u64,
        /// Seed of the scrambles.
        seed: u64,
    },
}

/// Standard errors in the error column of Monte Carlo.
const STANDARD_ERRORS: f64 = 4.0;

const ALPHA: Input = Input { name: "alpha", min: 0.0, max: 1.0 };
const MU: Input = Input { name: "mu", min: 0.0, max: 1.0 };

/// Every quantity of this version.
pub static QUANTITIES: [Quantity; 2] = [
    Quantity { name: "ggx-reflection", inputs: &[ALPHA, MU], outputs: &["E", "A", "B", "loss", "error"] },
    Quantity { name: "ggx-average", inputs: &[ALPHA], outputs: &["E_avg", "loss_avg", "error"] },
];

impl Quantity {
    /// The quantity of a name.
    pub fn find(name: &str) -> Option<&'static Quantity> {
        QUANTITIES.iter().find(|q| q.name == name)
    }

    /// The outputs at one point.
    ///
    /// # Panics
    /// If `inputs` has not the length of [`Quantity::inputs`].
    pub fn evaluate(&self, smith: Smith, inputs: &[f64], method: Method) -> Result<Vec<f64>, IntegrateError> {
        assert_eq!(inputs.len(), self.inputs.len(), "inputs of {}", self.name);
        match (self.name, method) {
            ("ggx-reflection", Method::Quadrature { tolerance }) => {
                let v = reflection::reflection(smith, inputs[0], inputs[1], tolerance)?;
                Ok(vec![v.e, v.a, v.b, v.loss, v.error])
            }
            ("ggx-reflection", Method::MonteCarlo { samples, seed }) => {
                let v = monte_carlo::reflection(smith, inputs[0], inputs[1], run(samples, seed))?;
                let worst = [v.e, v.a, v.b, v.loss].iter().fold(0.0_f64, |w, x| x.standard_error.max(w));
                Ok(vec![v.e.value, v.a.value, v.b.value, v.loss.value, STANDARD_ERRORS * worst])
            }
            (_, Method::Quadrature { tolerance }) => {
                let v = reflection::average(smith, inputs[0], tolerance)?;
                Ok(vec![v.e_avg, v.loss_avg, v.error])
            }
            (_, Method::MonteCarlo { samples, seed }) => {
                let (e, loss) = monte_carlo::average(smith, inputs[0], run(samples, seed))?;
                let worst = e.standard_error.max(loss.standard_error);
                Ok(vec![e.value, loss.value, STANDARD_ERRORS * worst])
            }
        }
    }
}

fn run(samples: u64, seed: u64) -> Run {
    Run { samples, seed, points: Points::Sobol, draw: Draw::VisibleNormal }
}
