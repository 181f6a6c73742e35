//! What accuracy costs in seconds, as measured on one machine: not reproducible, so kept apart from the findings.

use serde::Serialize;

use super::Origin;
use crate::data::Use;

/// Measured times, offline and at run time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Timings {
    /// What made it.
    pub origin: Origin,
    /// The machine, in words.
    pub device: String,
    /// Error against seconds at single points.
    pub points: Vec<TimedPoint>,
    /// Time per evaluation of each approximation.
    pub evaluations: Vec<TimedApproximation>,
}

/// Error against seconds at one point of a quantity's domain.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimedPoint {
    /// What makes the point worth looking at.
    pub name: String,
    /// GGX alpha.
    pub alpha: f64,
    /// Cosine.
    pub mu: f64,
    /// One per integrator.
    pub series: Vec<TimedSeries>,
}

/// Error of one integrator against the time it took.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimedSeries {
    /// Name of the integrator.
    pub name: String,
    /// Seconds, positive.
    pub seconds: Vec<f64>,
    /// Absolute error at each.
    pub error: Vec<f64>,
}

/// What one approximation takes at run time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimedApproximation {
    /// Name of the approximation.
    pub name: String,
    /// Quantity that it approximates.
    pub quantity: String,
    /// Column of the quantity.
    pub column: String,
    /// What it is used as; decides what its error means.
    #[serde(rename = "use")]
    pub used_as: Use,
    /// Nanoseconds per evaluation, measured.
    pub nanoseconds: f64,
    /// Operations by the model of [`crate::data::Cost`].
    pub ops: u32,
    /// Largest error of its use.
    pub max_error: f64,
    /// Somebody else's.
    pub published: bool,
    /// A table, not a formula.
    pub table: bool,
}
