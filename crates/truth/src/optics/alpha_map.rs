//! The roughness map, without which a GGX figure means nothing.

use serde::{Deserialize, Serialize};

/// How the artist's roughness becomes the GGX width alpha.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// Every map.
    pub const ALL: [AlphaMap; 3] =
        [AlphaMap::Roughness, AlphaMap::RoughnessSquared, AlphaMap::RoughnessFourth];

    /// The word used in scenes, headers and the manifest.
    pub fn name(self) -> &'static str {
        match self {
            AlphaMap::Roughness => "roughness",
            AlphaMap::RoughnessSquared => "roughness^2",
            AlphaMap::RoughnessFourth => "roughness^4",
        }
    }

    /// n of alpha = roughness^n.
    pub fn power(self) -> u32 {
        match self {
            AlphaMap::Roughness => 1,
            AlphaMap::RoughnessSquared => 2,
            AlphaMap::RoughnessFourth => 4,
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

    /// The roughness of an alpha in [0, 1]: the inverse of [`AlphaMap::alpha`].
    pub fn roughness(self, alpha: f64) -> f64 {
        match self {
            AlphaMap::Roughness => alpha,
            AlphaMap::RoughnessSquared => alpha.sqrt(),
            AlphaMap::RoughnessFourth => alpha.sqrt().sqrt(),
        }
    }

    /// alpha as shader code of the variable of this name.
    pub fn alpha_source(self, roughness: &str) -> String {
        let square = format!("{roughness} * {roughness}");
        match self {
            AlphaMap::Roughness => roughness.into(),
            AlphaMap::RoughnessSquared => square,
            AlphaMap::RoughnessFourth => format!("({square}) * ({square})"),
        }
    }

    /// The roughness as shader code of an expression that is alpha.
    pub fn roughness_source(self, alpha: &str) -> String {
        match self {
            AlphaMap::Roughness => alpha.into(),
            AlphaMap::RoughnessSquared => format!("sqrt({alpha})"),
            AlphaMap::RoughnessFourth => format!("sqrt(sqrt({alpha}))"),
        }
    }
}
