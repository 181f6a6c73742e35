//! What accuracy costs offline, as measured on one processor: not reproducible, so kept apart from the
//! findings of a bake.

use serde::{Deserialize, Serialize};

use lobefit_truth::accuracy::{Curve, PathTracer, Tables, Walk};

/// Error against evaluations and seconds of every way to compute every quantity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OfflineRecord {
    /// The processor; seconds are those of one thread.
    pub device: String,
    /// Each quantity at its easy and at its hard point.
    pub studies: Vec<OfflineStudy>,
}

/// One quantity at one point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OfflineStudy {
    /// The quantity.
    pub quantity: String,
    /// Its output.
    pub output: String,
    /// Inputs and choices, in words.
    pub at: String,
    /// Bound of the error of the truth.
    pub bound: f64,
    /// Every way.
    pub curves: Vec<Curve>,
    /// The setting of the path tracer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path_tracer: Option<PathTracer>,
    /// The random walk.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub walk: Option<Walk>,
    /// Tables over two of the inputs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tables: Option<Tables>,
}
