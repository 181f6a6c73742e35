//! The part of a glTF 2.0 document that says what its surfaces are. Geometry is not read; where the
//! images are is a part of its own ([`super::images`]).

use std::collections::BTreeSet;
use std::fmt;

use lobefit_strict::number::{In, NotNegative, Numbers, Unit};
use lobefit_strict::value::{List, Maybe};

use serde::Deserialize;
use serde::de::{Deserializer, SeqAccess, Visitor};

use crate::limits;

/// A factor of a texture, or the value itself where there is none.
type Factor = Maybe<In<Unit>>;

/// What a texture's place holds.
#[derive(Deserialize)]
#[serde(expecting = "an object with the `index` of a texture")]
pub(super) struct Texture {
    pub index: usize,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "a glTF document, an object")]
pub(super) struct Document {
    pub asset: Asset,
    #[serde(default)]
    pub extensions_used: Maybe<List<String, { limits::GLTF_EXTENSIONS }>>,
    #[serde(default)]
    pub materials: Maybe<List<Material, { limits::MATERIALS }>>,
    #[serde(default)]
    pub meshes: Maybe<List<Mesh, { limits::GLTF_LIST }>>,
}

#[derive(Deserialize)]
#[serde(expecting = "an object with a `version`")]
pub(super) struct Asset {
    pub version: String,
}

/// The version alone, of a file whose other fields may be those of another one.
#[derive(Deserialize)]
pub(super) struct Versioned {
    pub asset: AnyAsset,
}

#[derive(Deserialize)]
pub(super) struct AnyAsset {
    pub version: AnyVersion,
}

/// A version as any of glTF states it.
#[derive(Deserialize)]
#[serde(untagged)]
pub(super) enum AnyVersion {
    Text(String),
    Number(f64),
}

#[derive(Deserialize)]
#[serde(expecting = "an object that describes a mesh")]
pub(super) struct Mesh {
    pub primitives: Primitives,
}

/// What the primitives of a mesh are made of.
#[derive(Default)]
pub(super) struct Primitives {
    /// Materials of primitives and of their variants.
    pub materials: BTreeSet<usize>,
    /// Whether one has none.
    pub has_bare: bool,
}

impl<'de> Deserialize<'de> for Primitives {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Each;
        impl<'de> Visitor<'de> for Each {
            type Value = Primitives;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a list of primitives")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Primitives, A::Error> {
                let mut all = Primitives::default();
                while let Some(Primitive { material, extensions }) = seq.next_element()? {
                    all.has_bare |= material.0.is_none();
                    let variants = extensions.0.and_then(|extensions| extensions.variants.0);
                    let variants = variants.into_iter().flat_map(|variants| variants.mappings.0);
                    all.materials.extend(material.0.into_iter().chain(variants.map(|one| one.material)));
                }
                Ok(all)
            }
        }
        deserializer.deserialize_seq(Each)
    }
}

#[derive(Deserialize)]
#[serde(expecting = "an object that describes a primitive")]
struct Primitive {
    #[serde(default)]
    material: Maybe<usize>,
    #[serde(default)]
    extensions: Maybe<PrimitiveExtensions>,
}

#[derive(Deserialize)]
#[serde(expecting = "an object of extensions")]
struct PrimitiveExtensions {
    #[serde(default, rename = "KHR_materials_variants")]
    variants: Maybe<Variants>,
}

#[derive(Deserialize)]
#[serde(expecting = "an object with `mappings`")]
struct Variants {
    mappings: List<Mapping, { limits::MATERIALS }>,
}

#[derive(Deserialize)]
#[serde(expecting = "an object with a `material`")]
struct Mapping {
    material: usize,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object that describes a material")]
pub(super) struct Material {
    pub name: Maybe<String>,
    pub pbr_metallic_roughness: Metallic,
    pub extensions: Extensions,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object of metallic-roughness")]
pub(super) struct Metallic {
    pub base_color_factor: Maybe<Numbers<In<Unit>, 4, false>>,
    pub base_color_texture: Maybe<Texture>,
    pub metallic_factor: Factor,
    pub roughness_factor: Factor,
    pub metallic_roughness_texture: Maybe<Texture>,
}

/// The extensions of a material that say something of its lobes.
#[derive(Default, Deserialize)]
#[serde(default, expecting = "an object of extensions")]
pub(super) struct Extensions {
    #[serde(rename = "KHR_materials_anisotropy")]
    pub anisotropy: Maybe<Anisotropy>,
    #[serde(rename = "KHR_materials_clearcoat")]
    pub clearcoat: Maybe<Clearcoat>,
    #[serde(rename = "KHR_materials_diffuse_transmission")]
    pub diffuse_transmission: Maybe<DiffuseTransmission>,
    #[serde(rename = "KHR_materials_dispersion")]
    pub dispersion: Maybe<Dispersion>,
    #[serde(rename = "KHR_materials_ior")]
    pub ior: Maybe<Ior>,
    #[serde(rename = "KHR_materials_iridescence")]
    pub iridescence: Maybe<Iridescence>,
    #[serde(rename = "KHR_materials_pbrSpecularGlossiness")]
    pub glossiness: Maybe<Glossiness>,
    #[serde(rename = "KHR_materials_sheen")]
    pub sheen: Maybe<Sheen>,
    #[serde(rename = "KHR_materials_specular")]
    pub specular: Maybe<Specular>,
    #[serde(rename = "KHR_materials_transmission")]
    pub transmission: Maybe<Transmission>,
    #[serde(rename = "KHR_materials_unlit")]
    pub unlit: Maybe<Unlit>,
    #[serde(rename = "KHR_materials_volume")]
    pub volume: Maybe<Volume>,
}

/// The names of these, and of those that say nothing of a lobe. A note names any other extension of
/// materials.
pub(super) const KNOWN: [&str; 14] = [
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
];

/// An extension of one struct of optional fields.
macro_rules! extension {
    ($name:ident { $($field:ident: $kind:ty),* $(,)? }) => {
        #[derive(Default, Deserialize)]
        #[serde(rename_all = "camelCase", default, expecting = "an object of the extension")]
        pub(super) struct $name { $(pub $field: $kind,)* }
    };
}

extension!(Anisotropy { anisotropy_strength: Factor, anisotropy_texture: Maybe<Texture>, });
extension!(Clearcoat {
    clearcoat_factor: Factor,
    clearcoat_texture: Maybe<Texture>,
    clearcoat_roughness_factor: Factor,
    clearcoat_roughness_texture: Maybe<Texture>,
});
extension!(DiffuseTransmission {
    diffuse_transmission_factor: Factor,
    diffuse_transmission_texture: Maybe<Texture>,
});
extension!(Dispersion { dispersion: Maybe<In<NotNegative>>, });
extension!(Ior { ior: Maybe<In<NotNegative>>, });
extension!(Iridescence { iridescence_factor: Factor, iridescence_texture: Maybe<Texture>, });
extension!(Glossiness {
    diffuse_factor: Maybe<Numbers<In<Unit>, 4, false>>,
    diffuse_texture: Maybe<Texture>,
    specular_factor: Maybe<Numbers<In<Unit>, 3, false>>,
    glossiness_factor: Factor,
    specular_glossiness_texture: Maybe<Texture>,
});
extension!(Sheen {
    sheen_color_factor: Maybe<Numbers<In<Unit>, 3, false>>,
    sheen_color_texture: Maybe<Texture>,
    sheen_roughness_factor: Factor,
    sheen_roughness_texture: Maybe<Texture>,
});
extension!(Specular {
    specular_factor: Factor,
    specular_texture: Maybe<Texture>,
    specular_color_factor: Maybe<Numbers<In<NotNegative>, 3, false>>,
    specular_color_texture: Maybe<Texture>,
});
extension!(Transmission { transmission_factor: Factor, transmission_texture: Maybe<Texture>, });
extension!(Unlit {});
extension!(Volume { thickness_factor: Maybe<In<NotNegative>>, });
