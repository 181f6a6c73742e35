//! Whole materials as functions of two directions, as pages show them.

use serde::Serialize;

/// The furnace of one f0: what a white material sends back less 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FurnaceRow {
    /// Reflectance at normal incidence.
    pub f0: f64,
    /// The largest departure in size, with its sign: above 0 the material makes light.
    pub worst: f64,
    /// Root of the mean square over the grid.
    pub rms: f64,
    /// Where the largest is.
    pub alpha: f64,
    /// Where the largest is.
    pub mu: f64,
}

/// Where two directions are exchanged.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ExchangeAt {
    /// GGX alpha.
    pub alpha: f64,
    /// Reflectance at normal incidence.
    pub f0: f64,
    /// Cosine of one direction.
    pub mu_l: f64,
    /// Cosine of the other.
    pub mu_v: f64,
    /// Azimuth between them in degrees.
    pub azimuth: f64,
}

/// One lobe over one coupling.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReciprocityRow {
    /// Name of the lobe.
    pub lobe: String,
    /// Name of the coupling; none: the lobe alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coupling: Option<String>,
    /// Whether f(l, v) = f(v, l) by its formula.
    pub reciprocal: bool,
    /// Furnace of a white base by f0; of the lobe alone only at f0 = 1, where all light must come
    /// back.
    pub furnace: Vec<FurnaceRow>,
    /// Largest |f(l, v) - f(v, l)| over the mean of their sizes, 2 at most.
    pub reciprocity: f64,
    /// Where.
    pub at: ExchangeAt,
    /// Operations beyond specular + diffuse, one channel.
    pub ops: u32,
    /// Texels read.
    pub fetches: u32,
}
