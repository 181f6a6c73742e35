//! What the coefficients of a fit minimise.

use serde::{Deserialize, Serialize};

/// The error that coefficients minimise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Norm {
    /// The largest error.
    Max,
    /// The root of the mean square error.
    Rms,
}

impl Norm {
    /// The word used in scenes, names of fits and the manifest.
    pub fn name(self) -> &'static str {
        match self {
            Norm::Max => "max",
            Norm::Rms => "rms",
        }
    }
}
