//! The masking-shadowing form without which a GGX figure means nothing.

use serde::{Deserialize, Serialize};

/// The Smith masking-shadowing form (Heitz 2014): part of a quantity's name wherever it is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Smith {
    /// Height-correlated, G2 = 1/(1 + Lambda_v + Lambda_l) (Heitz 2014, eq. 99).
    #[default]
    Correlated,
    /// Separable, G2 = G1(v) G1(l).
    Separable,
}

impl Smith {
    /// Both forms, the usual one first.
    pub const ALL: [Smith; 2] = [Smith::Correlated, Smith::Separable];

    /// The word used in file names, headers, the manifest and options.
    pub fn name(self) -> &'static str {
        match self {
            Smith::Correlated => "correlated",
            Smith::Separable => "separable",
        }
    }
}
