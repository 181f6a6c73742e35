//! A material: metal or dielectric, its roughness range and its reflectance.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::limits::SMOOTH_ALPHA;
use super::name::Name;
use super::number::{In, Ior, Numbers, Span, Unit};
use super::value::{Maybe, Text, Word, from_file};
use super::wants::Wants;
use crate::data::AlphaMap;
use crate::optics::fresnel::f0_of_ior;

/// What a material is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Reflects only.
    Metal,
    /// Reflects at its surface and scatters below it.
    Dielectric,
}

impl Kind {
    /// The word used in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Metal => "metal",
            Kind::Dielectric => "dielectric",
        }
    }
}

/// A validated material.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Material {
    /// Name, unique in its scene, without control characters; escape it where it is printed.
    pub name: String,
    /// Metal or dielectric.
    pub kind: Kind,
    /// Reflectance at normal incidence, per colour channel, in [0, 1].
    pub f0: [f64; 3],
    /// Index of refraction in (1, 4] where the scene gave that.
    pub ior: Option<f64>,
    /// Roughness range in [0, 1], lo <= hi.
    pub roughness: [f64; 2],
    /// What is wanted of its specular lobe.
    pub wants: Wants,
}

impl Material {
    /// The part of the roughness range whose lobe is rough (alpha >= [`SMOOTH_ALPHA`]), or `None` for a smooth material.
    pub fn rough_range(&self, map: AlphaMap) -> Option<[f64; 2]> {
        let [lo, hi] = self.roughness;
        (map.alpha(hi) >= SMOOTH_ALPHA).then(|| [lo.max(smallest_rough(map)), hi])
    }
}

/// The roughness at which alpha is [`SMOOTH_ALPHA`]: the root of the map, whose alpha is not below it in f64.
pub fn smallest_rough(map: AlphaMap) -> f64 {
    match map {
        AlphaMap::Roughness => 1e-4,
        AlphaMap::RoughnessSquared => 1e-2,
        AlphaMap::RoughnessFourth => 1e-1,
    }
}

/// A material.
#[derive(Deserialize, JsonSchema)]
// Exactly one of `f0` and `ior`, and `f0` unless it is a dielectric.
#[schemars(rename = "Material", extend(
    "oneOf" = [{ "required": ["f0"] }, { "required": ["ior"] }],
    "anyOf" = [{ "required": ["f0"] }, { "properties": { "kind": { "const": "dielectric" } } }],
))]
#[serde(deny_unknown_fields, expecting = "an object that describes a material")]
struct MaterialFile {
    /// Name, unique in the scene, without control characters.
    name: Text<Name>,
    /// `metal` or `dielectric`.
    kind: Word<Kind>,
    /// Reflectance at normal incidence: a number, or one for red, green and blue. A metal needs it; a dielectric has
    /// either this or `ior`.
    #[serde(default)]
    f0: Maybe<Numbers<In<Unit>, 3, true>>,
    /// Index of refraction of a dielectric.
    #[serde(default)]
    ior: Maybe<In<Ior>>,
    /// Roughness: a number, or the range [lo, hi] that the material's texture spans. Where alpha is below 0.0001 the
    /// surface counts as smooth and calls for no rough specular.
    roughness: Span<Unit, true>,
    /// What is wanted; without it a table and fits, with their defaults.
    #[serde(default)]
    wants: Maybe<Wants>,
}

impl TryFrom<MaterialFile> for Material {
    type Error = String;

    fn try_from(file: MaterialFile) -> Result<Self, String> {
        let kind = file.kind.0;
        let f0 = file.f0.0.map(|Numbers([r, g, b])| [r.0, g.0, b.0]);
        let ior = file.ior.0.map(|n| n.0);
        let f0 = match (kind, f0, ior) {
            (Kind::Metal, _, Some(_)) => return Err("`ior` is for dielectrics; give the metal's `f0`".into()),
            (Kind::Metal, None, None) => return Err("a metal needs `f0`".into()),
            (Kind::Dielectric, None, None) => return Err("a dielectric needs `ior` or `f0`".into()),
            (Kind::Dielectric, Some(_), Some(_)) => {
                return Err("`ior` and `f0` are both given; a dielectric needs exactly one of them".into());
            }
            (_, Some(f0), None) => f0,
            (Kind::Dielectric, None, Some(n)) => [f0_of_ior(n); 3],
        };
        let wants = file.wants.0.map_or_else(Wants::both, Ok)?;
        Ok(Material { name: file.name.0, kind, f0, ior, roughness: file.roughness.0, wants })
    }
}

from_file!(Material, MaterialFile);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smooth_end_is_rough_in_f64() {
        for map in [AlphaMap::Roughness, AlphaMap::RoughnessSquared, AlphaMap::RoughnessFourth] {
            let alpha = map.alpha(smallest_rough(map));
            assert!((SMOOTH_ALPHA..SMOOTH_ALPHA * (1.0 + 1e-12)).contains(&alpha), "{map:?}: {alpha}");
        }
    }
}
