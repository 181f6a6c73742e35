//! What was measured of an approximation: the same figures for a table, a fit and somebody else's
//! code.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// A point of the domain, by input name (`alpha`, `roughness`, `mu`, ...).
pub type Place = BTreeMap<String, f64>;

/// The f64 with the fewest decimal digits that rounds to this f32: how a place is written.
pub fn shortest(x: f32) -> f64 {
    x.to_string().parse().unwrap_or(f64::from(x))
}

/// To nine digits: how the range of an alpha is written, since 0.1 squared is 0.01.
pub fn nine_digits(x: f64) -> f64 {
    format!("{x:.8e}").parse().unwrap_or(x)
}

/// A formula or a lookup in half precision: inputs, coefficients, the texel that is fetched and every
/// operation rounded to f16, products contracted into the sums that use them or not, whichever errs more.
/// A compiler that keeps f32 has the error of the [`Certificate`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Half {
    /// Its error, where it is finite at every measured point.
    Measured(HalfError),
    /// What is not finite.
    Refused(HalfRefusal),
}

impl Half {
    /// The one that errs more, a refusal before any; the first of equals.
    pub fn or_worse(self, other: Half) -> Half {
        match (&self, &other) {
            (Half::Refused(_), _) => self,
            (_, Half::Refused(_)) => other,
            (Half::Measured(a), Half::Measured(b)) => {
                if b.max_abs > a.max_abs {
                    other
                } else {
                    self
                }
            }
        }
    }
}

/// Error of a formula or a lookup in half precision, over the domain and at the points of its certificate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HalfError {
    /// Largest absolute error.
    pub max_abs: f64,
    /// Root of the mean square error.
    pub rms: f64,
    /// Where `max_abs` is attained, before the inputs are rounded.
    pub at: Place,
    /// The arithmetic of the two that errs more: `f16` or `f16-fma`.
    pub precision: String,
}

impl From<&Result<Certificate, HalfRefusal>> for Half {
    fn from(found: &Result<Certificate, HalfRefusal>) -> Self {
        match found {
            Ok(Certificate { max_abs, rms, at, precision, .. }) => Half::Measured(HalfError {
                max_abs: *max_abs,
                rms: *rms,
                at: at.clone(),
                precision: precision.clone(),
            }),
            Err(refusal) => Half::Refused(refusal.clone()),
        }
    }
}

/// Why a formula or a lookup is not for half precision.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HalfRefusal {
    /// What is not finite, and where in the formula.
    pub refused: String,
    /// The point, before the inputs are rounded; empty where a coefficient is beyond the range.
    pub at: Place,
}

/// Measured error of an approximation over its domain.
///
/// `max_abs` is the largest error at the measured points, rounded up in its last printed digit; the
/// points are never those that the approximation was fitted on. For the use `normalisation` the
/// error is the furnace error |E N - 1|.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// Largest absolute error.
    pub max_abs: f64,
    /// Largest relative error (error / |truth|; for a normalisation the truth is 1).
    pub max_rel: f64,
    /// Root of the mean square error.
    pub rms: f64,
    /// Signed mean error: a bias.
    pub mean: f64,
    /// Where `max_abs` is attained.
    pub at: Place,
    /// Domain over which it was measured, by input.
    pub domain: BTreeMap<String, [f64; 2]>,
    /// Arithmetic of the approximation while it was measured: `f32`, `f16 texels, f32 lookup`, ...
    pub precision: String,
    /// Number of points measured.
    pub points: u64,
}
