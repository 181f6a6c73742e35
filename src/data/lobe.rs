//! The two choices without which a GGX figure means nothing: the shadowing form and the roughness map.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The Smith masking-shadowing form (Heitz 2014): part of a quantity's name wherever it is written.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Smith {
    /// Height-correlated, G2 = 1/(1 + Lambda_v + Lambda_l) (Heitz 2014, eq. 99).
    #[default]
    Correlated,
    /// Separable, G2 = G1(v) G1(l).
    Separable,
}

impl Smith {
    /// The word used in file names, headers, the manifest and options.
    pub fn name(self) -> &'static str {
        match self {
            Smith::Correlated => "correlated",
            Smith::Separable => "separable",
        }
    }
}

/// How the artist's roughness becomes the GGX width alpha.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
pub enum AlphaMap {
    /// alpha = roughness.
    #[serde(rename = "roughness")]
    Roughness,
    /// alpha = roughness^2, the common parameterisation.
    #[default]
    #[serde(rename = "roughness^2")]
    RoughnessSquared,
    /// alpha = roughness^4.
    #[serde(rename = "roughness^4")]
    RoughnessFourth,
}

impl AlphaMap {
    /// The word used in scenes, headers and the manifest.
    pub fn name(self) -> &'static str {
        match self {
            AlphaMap::Roughness => "roughness",
            AlphaMap::RoughnessSquared => "roughness^2",
            AlphaMap::RoughnessFourth => "roughness^4",
        }
    }

    /// alpha of a roughness in [0, 1]; exact multiplications only.
    pub fn alpha(self, roughness: f64) -> f64 {
        let square = roughness * roughness;
        match self {
            AlphaMap::Roughness => roughness,
            AlphaMap::RoughnessSquared => square,
            AlphaMap::RoughnessFourth => square * square,
        }
    }

    /// The f32 alpha that a shader computes from an f32 roughness.
    pub fn alpha_f32(self, roughness: f32) -> f32 {
        let square = roughness * roughness;
        match self {
            AlphaMap::Roughness => roughness,
            AlphaMap::RoughnessSquared => square,
            AlphaMap::RoughnessFourth => square * square,
        }
    }
}
