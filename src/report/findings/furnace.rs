//! The furnace and the study of accuracy against work, as the page shows them.

use serde::{Deserialize, Serialize};

/// Spheres in a white environment: rows of approximations, columns of roughness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Furnace {
    /// Roughness of each column.
    pub roughness: Vec<f64>,
    /// Cosines at which the factors are given, increasing; the picture interpolates linearly.
    pub mu: Vec<f64>,
    /// The rows; the first is the uncompensated lobe, which is also shown unamplified.
    pub rows: Vec<FurnaceRow>,
    /// How many times the departure from white is amplified: 10 gives the deepest colours to a
    /// departure of 0.1.
    pub amplification: f64,
}

/// One row of spheres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FurnaceRow {
    /// Name of the approximation, or `uncompensated`.
    pub name: String,
    /// The approximation that it shows; empty where there is none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub of: String,
    /// `factors[column][k]` = E N at `mu[k]`.
    #[serde(serialize_with = "lobefit_figures::drawn_lists")]
    pub factors: Vec<Vec<f64>>,
}

/// Error against work at one point of a quantity's domain.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Study {
    /// What makes the point worth looking at: `easy`, `hard`.
    pub name: String,
    /// GGX alpha.
    pub alpha: f64,
    /// Cosine.
    pub mu: f64,
    /// One per integrator.
    pub series: Vec<StudySeries>,
    /// The setting of the path tracer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub marked: Option<Marked>,
}

/// Error of one integrator against its work.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StudySeries {
    /// Name of the integrator.
    pub name: String,
    /// Evaluations of the integrand, increasing.
    pub evaluations: Vec<u64>,
    /// Absolute error at each; 0 is drawn on the foot of the chart.
    pub error: Vec<f64>,
}

/// A setting with two kinds of error.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Marked {
    /// What the setting is: `10 million samples, f32 running sum`.
    pub name: String,
    /// Evaluations of the integrand.
    pub evaluations: u64,
    /// Error by noise.
    pub noise: f64,
    /// Error by bias, as of a rounded running sum.
    pub bias: f64,
}
