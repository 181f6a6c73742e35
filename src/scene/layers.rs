//! What a material has beside its specular lobe: a diffuse base below it, a coat and a sheen layer above
//! it, each with what is wanted of it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::goals::{Goals, Norms};
use super::limits;
use super::material::{Lobe, rough_part};
use super::number::{ErrorLimit, GlassIor, In, Numbers, Ops, Span, Unit, Whole};
use super::table::{OpenTable, TableWant, different};
use super::value::{List, Maybe, Word, about, from_file};
use crate::data::{AlphaMap, Serves};
use lobefit_truth::quantity::Specular;

/// A diffuse base under the specular lobe: Lambert's, or where it is rough that of EON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Base {
    /// Albedo per colour channel, in [0, 1]. It scales the base's share of the light and the error
    /// of the share: the factor does not depend on the albedo.
    pub albedo: [f64; 3],
    /// Roughness range of the base itself in [0, 1], lo <= hi: that of Oren and Nayar's lobe, not
    /// squared; 0 is Lambert's.
    #[serde(skip_serializing_if = "is_smooth")]
    pub roughness: [f64; 2],
    /// What multiplies the specular lobe above it: the factor is what that leaves.
    pub specular: Specular,
    /// What the fits of the factor must keep, and of a rough base those of its own albedo.
    #[serde(flatten)]
    pub goals: Goals,
}

impl Base {
    /// Whether it sends back no light: then nothing is coupled with the specular lobe.
    pub fn is_black(&self) -> bool {
        self.albedo == [0.0; 3]
    }

    /// Whether its lobe is another than Lambert's.
    pub fn is_rough(&self) -> bool {
        !is_smooth(&self.roughness)
    }
}

fn is_smooth(roughness: &[f64; 2]) -> bool {
    roughness[1] == 0.0
}

/// The diffuse base of a dielectric. Lambert's lobe calls for fits of the factor that a white base
/// is multiplied by so that base and specular lobe together send back exactly all light; an albedo
/// below 1 scales the base's share alone, and its error as well. A rough base calls for fits of the
/// albedo of its own lobe besides; its limits hold for those too.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Base")]
#[serde(deny_unknown_fields, default, expecting = "an object that describes a diffuse base")]
struct BaseFile {
    /// Albedo of the base: a number, or one for red, green and blue; default 1, white. A black base
    /// calls for nothing.
    albedo: Maybe<Numbers<In<Unit>, 3, true>>,
    /// Roughness of the base itself: a number, or the range [lo, hi] that the material's texture
    /// spans; default 0, Lambert's lobe. Above 0 the base is that of EON (Portsmouth, Kutz and Hill
    /// 2024), whose roughness is not squared.
    roughness: Maybe<Span<Unit, true>>,
    /// What the renderer multiplies the specular lobe by: `single` nothing; `normalised` 1/E (the
    /// default); `compensated` 1 + f0 (1/E - 1).
    specular: Maybe<Word<Specular>>,
    /// Most operations that an emitted fit may take; default: any number.
    max_ops: Maybe<Whole<Ops>>,
    /// Error of the factor that at least one emitted fit within `max_ops` must meet, else the bake
    /// fails; default: no limit.
    max_error: Maybe<In<ErrorLimit>>,
    /// Errors to minimise, `max` or `rms`, one fit each; default `max`.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    norms: Norms,
}

impl TryFrom<BaseFile> for Base {
    type Error = String;

    fn try_from(file: BaseFile) -> Result<Self, String> {
        Ok(Base {
            albedo: file.albedo.0.map_or([1.0; 3], |Numbers([r, g, b])| [r.0, g.0, b.0]),
            roughness: file.roughness.0.map_or([0.0; 2], |range| range.0),
            specular: file.specular.0.map_or_else(Specular::default, |w| w.0),
            goals: Goals::read(file.max_ops, file.max_error, file.norms)?,
        })
    }
}

from_file!(Base, BaseFile);

/// What the lobe of a sheen is shadowed by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Visibility {
    /// 1/(4 (mu + mu_l - mu mu_l)) of Neubelt and Pettineo (2013), which real-time renderers take.
    #[default]
    Neubelt,
    /// The Lambda that the lobe's authors fitted (2017), without their softer terminator; the whole is not
    /// clamped.
    EstevezKulla,
}

impl Visibility {
    /// Whether it is the default.
    pub fn is_default(&self) -> bool {
        *self == Visibility::default()
    }

    /// Whose it is.
    pub fn words(self) -> &'static str {
        match self {
            Visibility::Neubelt => "the visibility of Neubelt and Pettineo",
            Visibility::EstevezKulla => "the shadowing of Estevez and Kulla",
        }
    }
}

/// A sheen layer: the lobe of Estevez and Kulla (2017).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sheen {
    /// Roughness range in [0, 1], lo <= hi; the scene's map makes alpha of it.
    pub roughness: [f64; 2],
    /// What the fits of E must keep.
    #[serde(flatten)]
    pub goals: Goals,
    /// Tables of E beside the fits.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tables: Vec<TableWant>,
}

impl Sheen {
    /// The part of its roughness range whose lobe is rough.
    pub fn rough_range(&self, map: AlphaMap) -> Option<[f64; 2]> {
        rough_part(self.roughness, map)
    }
}

/// A sheen layer, as of cloth (the lobe of Estevez and Kulla 2017), which calls for fits of its
/// albedo E. At grazing E exceeds 1, the more the smaller its alpha is.
#[derive(Deserialize, JsonSchema)]
#[schemars(rename = "Sheen")]
#[serde(deny_unknown_fields, expecting = "an object that describes a sheen layer")]
struct SheenFile {
    /// Roughness of the sheen: a number, or the range [lo, hi] that the material's texture spans.
    /// Where alpha is below 0.0001 it calls for nothing.
    roughness: Span<Unit, true>,
    /// Most operations that an emitted fit may take; default: any number.
    #[serde(default)]
    max_ops: Maybe<Whole<Ops>>,
    /// Error of E that at least one emitted fit within `max_ops` must meet, else the bake fails;
    /// default: no limit.
    #[serde(default)]
    max_error: Maybe<In<ErrorLimit>>,
    /// Errors to minimise, `max` or `rms`, one fit each; default `max`.
    #[serde(default)]
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    norms: Norms,
    /// Tables of E over mu and roughness beside the fits; default none. At grazing E grows without
    /// bound as roughness falls: a range of `n_dot_v` or of roughness keeps the error of a table small.
    #[serde(default)]
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    tables: Maybe<List<OpenTable, { limits::TABLES }>>,
}

impl TryFrom<SheenFile> for Sheen {
    type Error = String;

    fn try_from(file: SheenFile) -> Result<Self, String> {
        let tables = file.tables.0.map_or_else(Vec::new, |list| list.0);
        let tables = different(tables, |table| table.of(Lobe::Isotropic), "tables")?;
        if let Some(i) = tables.iter().position(|table| table.serves != Serves::Albedo) {
            return Err(about(
                format!("tables[{i}].serves"),
                "a sheen has one albedo and no f0; leave it out",
            ));
        }
        Ok(Sheen {
            tables,
            roughness: file.roughness.0,
            goals: Goals::read(file.max_ops, file.max_error, file.norms)?,
        })
    }
}

from_file!(Sheen, SheenFile);

/// The dielectric that a metal is mixed with, as a texture of metalness does.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mixed {
    /// Range of the share of the metal in [0, 1], lo <= hi.
    pub metalness: [f64; 2],
    /// Reflectance of the dielectric at normal incidence, per colour channel, in [0, 1].
    pub f0: [f64; 3],
    /// What multiplies the dielectric's lobe.
    pub specular: Specular,
}

/// Reflectance of a dielectric that does not say: of an index of refraction of 1.5.
const MIXED_F0: f64 = 0.04;

/// The dielectric that a metal is mixed with where a texture of metalness lies between 0 and 1. Energy
/// compensation is not linear in f0, so that the finished lobes are mixed and not f0: a function of both
/// is emitted, with what the shortcut is off by.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Mixed")]
#[serde(deny_unknown_fields, default, expecting = "an object that describes a mixed dielectric")]
struct MixedFile {
    /// Share of the metal: a number, or the range [lo, hi] that the material's texture spans; default
    /// [0, 1].
    metalness: Maybe<Span<Unit, true>>,
    /// Reflectance of the dielectric at normal incidence: a number, or one for red, green and blue;
    /// default 0.04.
    f0: Maybe<Numbers<In<Unit>, 3, true>>,
    /// What the renderer multiplies the dielectric's lobe by, as in `base`: `normalised` (the default),
    /// `compensated` or `single`.
    specular: Maybe<Word<Specular>>,
}

impl TryFrom<MixedFile> for Mixed {
    type Error = String;

    fn try_from(file: MixedFile) -> Result<Self, String> {
        Ok(Mixed {
            metalness: file.metalness.0.map_or([0.0, 1.0], |range| range.0),
            f0: file.f0.0.map_or([MIXED_F0; 3], |Numbers([r, g, b])| [r.0, g.0, b.0]),
            specular: file.specular.0.map_or_else(Specular::default, |w| w.0),
        })
    }
}

from_file!(Mixed, MixedFile);

/// A dielectric coat above all else but the sheen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Coat {
    /// Roughness range in [0, 1], lo <= hi; the scene's map makes alpha of it. 0 is a smooth coat.
    pub roughness: [f64; 2],
    /// Range of its index of refraction in [1, 3], lo <= hi.
    pub ior: [f64; 2],
    /// What the fits of the share that leaves must keep.
    #[serde(flatten)]
    pub goals: Goals,
}

/// The index of refraction of a coat that does not say: that of glTF's clear coat.
const COAT_IOR: f64 = 1.5;

/// A clear coat above a dielectric, as of car paint, smooth or rough. It calls for fits of the share of
/// diffuse light from inside that leaves it, of which the darkening of the base below is made.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Coat")]
#[serde(deny_unknown_fields, default, expecting = "an object that describes a coat")]
struct CoatFile {
    /// Roughness of the coat: a number, or the range [lo, hi] that the material's texture spans; default 0,
    /// a smooth coat.
    roughness: Maybe<Span<Unit, true>>,
    /// Index of refraction of the coat: a number, or a range [lo, hi]; default 1.5.
    ior: Maybe<Span<GlassIor, true>>,
    /// Most operations that an emitted fit may take; default: any number.
    max_ops: Maybe<Whole<Ops>>,
    /// Relative error of the share that at least one emitted fit within `max_ops` must meet, else the bake
    /// fails; default: no limit.
    max_error: Maybe<In<ErrorLimit>>,
    /// Errors to minimise, `max` or `rms`, one fit each; default `max`.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    norms: Norms,
}

impl TryFrom<CoatFile> for Coat {
    type Error = String;

    fn try_from(file: CoatFile) -> Result<Self, String> {
        Ok(Coat {
            roughness: file.roughness.0.map_or([0.0; 2], |range| range.0),
            ior: file.ior.0.map_or([COAT_IOR; 2], |range| range.0),
            goals: Goals::read(file.max_ops, file.max_error, file.norms)?,
        })
    }
}

from_file!(Coat, CoatFile);
