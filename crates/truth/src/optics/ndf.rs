//! Which distribution of normals a surface has.

use serde::{Deserialize, Serialize};

/// The distribution of the normals of microfacets, by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Ndf {
    /// GGX, or Trowbridge-Reitz (1975).
    #[default]
    Ggx,
    /// Beckmann and Spizzichino (1963): slopes of facets are normal.
    Beckmann,
}

impl Ndf {
    /// The name in prose.
    pub fn name(self) -> &'static str {
        match self {
            Ndf::Ggx => "GGX",
            Ndf::Beckmann => "Beckmann",
        }
    }
}
