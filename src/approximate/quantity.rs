//! The quantities by name: what `eval` asks for and gives.

use crate::data::Smith;
use lobefit_truth::integrate::coupling::Specular;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::monte_carlo::{self, Run};
use lobefit_truth::integrate::{IntegrateError, aniso, coupling, footprint, glass, reflection, sheen};
use lobefit_truth::optics::kernel::Kernel;

/// What an input may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Values {
    /// A number in [min, max].
    Numbers {
        /// Smallest value.
        min: f64,
        /// Largest value.
        max: f64,
    },
    /// One of these words, given to [`Quantity::evaluate`] as its index.
    Words(&'static [&'static str]),
}

/// An input: its name and its values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input {
    /// Name of its column.
    pub name: &'static str,
    /// What it may be.
    pub values: Values,
    /// Whether its column may be absent; [`Quantity::evaluate`] then gets a NaN.
    pub optional: bool,
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

const fn number(name: &'static str, min: f64, max: f64) -> Input {
    Input { name, values: Values::Numbers { min, max }, optional: false }
}

const ALPHA: Input = number("alpha", 0.0, 1.0);
const MU: Input = number("mu", 0.0, 1.0);
/// Azimuth of the view from the alpha_x axis, radians; without it, the mean over it.
const PHI: Input =
    Input { name: "phi", values: Values::Numbers { min: f64::MIN, max: f64::MAX }, optional: true };
/// Where the ray comes from.
const SIDE: Input = Input { name: "side", values: Values::Words(&["outside", "inside"]), optional: false };

/// What multiplies the specular lobe.
const SPECULAR: Input = Input {
    name: "specular",
    values: Values::Words(&["single", "normalised", "compensated"]),
    optional: false,
};

/// The lobe that a chain is prefiltered with; without it, the half-angle lobe weighted by the cosine.
const KERNEL: Input =
    Input { name: "kernel", values: Values::Words(&["ndf", "half", "half-cosine"]), optional: true };

/// Every quantity of this version.
pub static QUANTITIES: [Quantity; 7] = [
    Quantity { name: "ggx-reflection", inputs: &[ALPHA, MU], outputs: &["E", "A", "B", "loss", "error"] },
    Quantity {
        name: "ggx-reflection-aniso",
        inputs: &[number("alpha_x", 0.0, aniso::ALPHA[1]), number("alpha_y", 0.0, aniso::ALPHA[1]), MU, PHI],
        outputs: &["E", "loss", "error"],
    },
    Quantity { name: "ggx-average", inputs: &[ALPHA], outputs: &["E_avg", "loss_avg", "error"] },
    Quantity {
        name: "ggx-glass",
        inputs: &[ALPHA, number("mu", glass::SMALLEST_MU, 1.0), number("ior", 1.0, glass::LARGEST_IOR), SIDE],
        outputs: &["R", "T", "E", "loss", "error"],
    },
    Quantity {
        name: "sheen-charlie",
        inputs: &[number("alpha", sheen::SMALLEST_ALPHA, 1.0), MU],
        outputs: &["E", "error"],
    },
    Quantity {
        name: "diffuse-coupling",
        inputs: &[ALPHA, MU, number("f0", 0.0, 1.0), SPECULAR],
        outputs: &["factor", "error"],
    },
    Quantity {
        name: "parallax-alpha",
        inputs: &[ALPHA, number("rho", footprint::RHO[0], footprint::RHO[1]), KERNEL],
        outputs: &["alpha_adjusted", "tv", "saturated", "error"],
    },
];

impl Quantity {
    /// `ggx-reflection`.
    pub fn ggx_reflection() -> &'static Quantity {
        &QUANTITIES[0]
    }

    /// `sheen-charlie`.
    pub fn sheen_charlie() -> &'static Quantity {
        &QUANTITIES[4]
    }

    /// `diffuse-coupling`.
    pub fn diffuse_coupling() -> &'static Quantity {
        &QUANTITIES[5]
    }

    /// `parallax-alpha`.
    pub fn parallax_alpha() -> &'static Quantity {
        &QUANTITIES[6]
    }

    /// The quantity of a name.
    pub fn find(name: &str) -> Option<&'static Quantity> {
        QUANTITIES.iter().find(|q| q.name == name)
    }

    /// The tolerance of a value when none is asked for: the quantity's promise.
    pub fn tolerance(&self) -> f64 {
        match self.name {
            "ggx-reflection-aniso" => aniso::TOLERANCE,
            "ggx-glass" => glass::TOLERANCE,
            "sheen-charlie" => sheen::TOLERANCE,
            "diffuse-coupling" => coupling::TOLERANCE,
            "parallax-alpha" => footprint::TOLERANCE,
            _ => reflection::TOLERANCE,
        }
    }

    /// Whether it has a Smith form: the visibility of a sheen has none, nor have footprints on a wall.
    pub fn has_smith(&self) -> bool {
        !matches!(self.name, "sheen-charlie" | "parallax-alpha")
    }

    /// The smallest alpha above 0 at which there is a truth; at 0 itself, a mirror, there may be one all the same.
    pub fn smallest_alpha(&self) -> f64 {
        match self.name {
            "ggx-glass" => glass::ALPHA[0],
            "ggx-reflection-aniso" => aniso::ALPHA[0],
            "sheen-charlie" => sheen::SMALLEST_ALPHA,
            "parallax-alpha" => footprint::SMALLEST_ALPHA,
            _ => reflection::SMALLEST_ALPHA,
        }
    }

    /// The outputs at one point.
    ///
    /// # Panics
    /// If `inputs` has not the length of [`Quantity::inputs`].
    pub fn evaluate(&self, smith: Smith, inputs: &[f64], method: Method) -> Result<Vec<f64>, IntegrateError> {
        assert_eq!(inputs.len(), self.inputs.len(), "inputs of {}", self.name);
        match method {
            Method::Quadrature { tolerance } => self.integrate(smith, inputs, tolerance),
            Method::MonteCarlo { samples, seed } => {
                let (mut values, errors) = self.sample(smith, inputs, monte_carlo::sobol(samples, seed))?;
                values.push(STANDARD_ERRORS * errors.into_iter().fold(0.0, f64::max));
                Ok(values)
            }
        }
    }

    fn integrate(&self, smith: Smith, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        Ok(match self.name {
            "ggx-reflection" => {
                let v = reflection::reflection(smith, x[0], x[1], tolerance)?;
                vec![v.e, v.a, v.b, v.loss, v.error]
            }
            "ggx-reflection-aniso" => {
                let v = aniso::aniso(smith, [x[0], x[1]], x[2], given(x[3]), tolerance)?;
                vec![v.e, v.loss, v.error]
            }
            "ggx-glass" => {
                let v = glass::glass(smith, x[0], x[1], x[2], side(x[3]), tolerance)?;
                vec![v.r, v.t, v.e, v.loss, v.error]
            }
            "sheen-charlie" => {
                let v = sheen::sheen(x[0], x[1], tolerance)?;
                vec![v.value, v.error]
            }
            "diffuse-coupling" => {
                let v = coupling::coupling(smith, x[0], x[1], x[2], specular(x[3]), tolerance)?;
                vec![v.value, v.error]
            }
            "parallax-alpha" => {
                let v = footprint::adjusted(kernel(x[2])?, x[0], x[1], tolerance)?;
                vec![v.alpha, v.tv, f64::from(u8::from(v.saturated)), v.error]
            }
            _ => {
                let v = reflection::average(smith, x[0], tolerance)?;
                vec![v.e_avg, v.loss_avg, v.error]
            }
        })
    }

    /// Values and their standard errors.
    fn sample(&self, smith: Smith, x: &[f64], run: Run) -> Result<(Vec<f64>, Vec<f64>), IntegrateError> {
        let columns = match self.name {
            "ggx-reflection" => {
                let v = monte_carlo::reflection(smith, x[0], x[1], run)?;
                vec![v.e, v.a, v.b, v.loss]
            }
            "ggx-reflection-aniso" => {
                monte_carlo::aniso(smith, [x[0], x[1]], x[2], given(x[3]), run)?.to_vec()
            }
            "ggx-glass" => {
                let [r, t, loss] = monte_carlo::glass(smith, x[0], x[1], x[2], side(x[3]), run)?;
                // The replicas of R and T are correlated: the sum's error is that of its complement.
                let e = monte_carlo::Sampled { value: r.value + t.value, ..loss };
                vec![r, t, e, loss]
            }
            "sheen-charlie" => vec![monte_carlo::sheen(x[0], x[1], run)?],
            "diffuse-coupling" => {
                vec![monte_carlo::coupling(smith, x[0], x[1], x[2], specular(x[3]), run)?]
            }
            "parallax-alpha" => {
                return Err(IntegrateError::Option {
                    option: "method",
                    value: "monte-carlo".into(),
                    must: "is not to be had of parallax-alpha, a minimum and not an integral: leave it out",
                });
            }
            _ => {
                let (e, loss) = monte_carlo::average(smith, x[0], run)?;
                vec![e, loss]
            }
        };
        Ok((columns.iter().map(|c| c.value).collect(), columns.iter().map(|c| c.standard_error).collect()))
    }
}

/// An optional input.
fn given(x: f64) -> Option<f64> {
    (!x.is_nan()).then_some(x)
}

/// The side of a word's index.
fn side(index: f64) -> Side {
    if index == 0.0 { Side::Outside } else { Side::Inside }
}

/// The lobe of a word's index, or of a table's that follows the words ([`Kernel::index`]).
fn kernel(index: f64) -> Result<Kernel, IntegrateError> {
    let Some(index) = given(index) else { return Ok(Kernel::default()) };
    let unknown = || IntegrateError::Domain {
        quantity: "parallax-alpha",
        input: "kernel",
        value: index,
        domain: "is the place of no kernel",
    };
    Kernel::at(index as usize).ok_or_else(unknown)
}

/// The specular lobe of a word's index.
fn specular(index: f64) -> Specular {
    match index as usize {
        0 => Specular::Single,
        1 => Specular::Normalised,
        _ => Specular::Compensated,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_are_where_they_are_looked_for() {
        assert_eq!(Quantity::ggx_reflection().name, "ggx-reflection");
        assert_eq!(Quantity::sheen_charlie().name, "sheen-charlie");
        assert_eq!(Quantity::parallax_alpha().name, "parallax-alpha");
    }
}
