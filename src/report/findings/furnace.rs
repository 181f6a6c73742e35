//! The furnace, as the page shows it.

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
