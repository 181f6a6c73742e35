//! What a material wants of its specular lobe: tables and fits.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::goals::{Goals, Norms};
use super::limits;
use super::material::Lobe;
use super::name::HypothesisPath;
use super::number::{ErrorLimit, In, LightRadius, MeanLength, Ops, Span, Whole};
use super::table::{OpenTable, TableWant, different};
use super::value::{List, Maybe, Text, about, from_file};
pub use crate::data::Norm;

/// Wanted fits.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitWant {
    /// What the normalisations must keep; the limit is of the furnace error.
    #[serde(flatten)]
    pub goals: Goals,
    /// Also fit the average albedo E_avg(alpha).
    pub average: bool,
    /// Also emit the reciprocal lobe of what is lost, which takes E_avg.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub multiscatter: bool,
    /// Also fit f0 A + B.
    // Absent where not wanted: the hash of a scene without it is that of the versions before it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub blend: bool,
    /// The user's own hypotheses, relative to the scene file.
    pub hypotheses: Vec<String>,
}

/// Wanted fits of one value of a lobe.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ValueWant {
    /// What they must keep; the limit is of the error of the value.
    #[serde(flatten)]
    pub goals: Goals,
}

/// What is wanted of a dielectric's lobe with the exact Fresnel term: fits of R, and tables beside them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExactWant {
    /// What the fits must keep; the limit is of the error of R.
    #[serde(flatten)]
    pub goals: Goals,
    /// Different tables, in the scene's order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tables: Vec<TableWant>,
}

/// Wanted fits of the roughness that stands for a widened lobe: at least one widening.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WidenedWant {
    /// What they must keep; the limit is of the error of the roughness.
    #[serde(flatten)]
    pub goals: Goals,
    /// Lengths of the mean of the normals that a texel averages.
    pub mean_length: Option<[f64; 2]>,
    /// Angular radii of lights, radians.
    pub light_radius: Option<[f64; 2]>,
    /// Whether the material's coat widens it.
    pub coat: bool,
}

/// At least one of them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Wants {
    /// Different tables, in the scene's order.
    pub tables: Vec<TableWant>,
    /// Fits of N of the isotropic lobe; of glass of N from either side.
    pub fit: Option<FitWant>,
    /// R with the exact Fresnel term, of a dielectric with an index of refraction.
    // Absent where not wanted: the hash of a scene without it is that of the versions before it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exact_fresnel: Option<ExactWant>,
    /// Fits of the roughness to fetch what glass refracts with.
    // Absent where not wanted, for the same reason.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refracted_width: Option<ValueWant>,
    /// Fits of the roughness that stands for what is widened.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub widened: Option<WidenedWant>,
}

/// Wants as the file has them; what the lobe decides is open.
pub(super) struct OpenWants {
    tables: Vec<OpenTable>,
    fit: Option<FitWant>,
    exact_fresnel: Option<ExactWant>,
    refracted_width: Option<ValueWant>,
    widened: Option<WidenedWant>,
}

/// What the material wants of its specular lobe: at least one of the fields. Without `wants`: a table
/// and fits, with their defaults; of anisotropic materials and of glass, a table with a third axis.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Wants", extend("minProperties" = 1))]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `tables`, `fit`, `exact_fresnel`, `refracted_width` or `widened`"
)]
struct WantsFile {
    /// Tables of the albedo for the shader to look up.
    #[serde(default)]
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    tables: Maybe<List<OpenTable, { limits::TABLES }>>,
    /// Formulas for the shader to evaluate: of an isotropic lobe, and of GGX glass without anisotropy, of
    /// reflection and transmission together, from either side.
    #[serde(default)]
    fit: Maybe<FitWant>,
    /// The lobe's albedo with the exact Fresnel term in place of Schlick's, as formulas and tables: of a
    /// dielectric with an `ior` of at most 3 and without anisotropy.
    #[serde(default)]
    exact_fresnel: Maybe<ExactWant>,
    /// Formulas of the roughness with which a prefiltered environment map or a blurred picture stands for
    /// what glass refracts, seen from outside: of glass, with alpha = roughness^2.
    #[serde(default)]
    refracted_width: Maybe<ValueWant>,
    /// Formulas of the roughness that stands for the specular lobe where something widens it, with alpha =
    /// roughness^2.
    #[serde(default)]
    widened: Maybe<WidenedWant>,
    /// Refused: a table is an entry of the list `tables`.
    #[serde(default)]
    #[schemars(skip)]
    table: Maybe<Renamed>,
}

/// The field `table`, which is an entry of `tables` now.
struct Renamed;

impl<'de> Deserialize<'de> for Renamed {
    fn deserialize<D: serde::Deserializer<'de>>(_: D) -> Result<Self, D::Error> {
        let message = "the field is now an entry of the list `tables`: write \"tables\": [{ ... }]";
        Err(serde::de::Error::custom(message))
    }
}

/// Fits of one value over roughness, mu and ior.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Value")]
#[serde(deny_unknown_fields, default, expecting = "an object that describes fits")]
struct ValueFile {
    /// Most operations that an emitted fit may take; default: any number.
    max_ops: Maybe<Whole<Ops>>,
    /// Error of the value that at least one emitted fit within `max_ops` must meet, else the bake fails;
    /// default: no limit.
    max_error: Maybe<In<ErrorLimit>>,
    /// Errors to minimise, `max` or `rms`, one fit each; default `max`.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    norms: Norms,
}

impl TryFrom<ValueFile> for ValueWant {
    type Error = String;

    fn try_from(file: ValueFile) -> Result<Self, String> {
        Ok(ValueWant { goals: Goals::read(file.max_ops, file.max_error, file.norms)? })
    }
}

/// Fits of R over roughness, mu and ior, and tables beside them.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "ExactFresnel")]
#[serde(deny_unknown_fields, default, expecting = "an object that describes fits and tables")]
struct ExactFile {
    /// Most operations that an emitted fit may take; default: any number.
    max_ops: Maybe<Whole<Ops>>,
    /// Error of R that at least one emitted fit within `max_ops` must meet, else the bake fails; default: no
    /// limit.
    max_error: Maybe<In<ErrorLimit>>,
    /// Errors to minimise, `max` or `rms`, one fit each; default `max`.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    norms: Norms,
    /// Tables of R over mu, roughness and ior beside the fits, in the layout `dielectric`; default none.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    tables: Maybe<List<OpenTable, { limits::TABLES }>>,
}

impl TryFrom<ExactFile> for ExactWant {
    type Error = String;

    fn try_from(file: ExactFile) -> Result<Self, String> {
        let goals = Goals::read(file.max_ops, file.max_error, file.norms)?;
        let tables = file.tables.0.map_or_else(Vec::new, |list| list.0);
        Ok(ExactWant { goals, tables: different(tables, OpenTable::of_exact_fresnel, "tables")? })
    }
}

/// Fits of the roughness of the widened lobe, of each widening that is given: at least one.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Widened", extend("anyOf" = [
    { "required": ["mean_length"] }, { "required": ["light_radius"] },
    { "required": ["coat"], "properties": { "coat": { "const": true } } },
]))]
#[serde(deny_unknown_fields, default, expecting = "an object that describes what widens a lobe")]
struct WidenedFile {
    /// Range [lo, hi] of the length of the mean of the normals that a texel of a normal map averages.
    mean_length: Maybe<Span<MeanLength, true>>,
    /// Range [lo, hi] of the angular radius of disk and sphere lights, in radians.
    light_radius: Maybe<Span<LightRadius, true>>,
    /// Whether the lobe is seen through the material's coat; default false.
    coat: Maybe<bool>,
    /// Most operations that an emitted fit may take; default: any number.
    max_ops: Maybe<Whole<Ops>>,
    /// Error of the roughness that at least one emitted fit of each within `max_ops` must meet, else the
    /// bake fails; default: no limit.
    max_error: Maybe<In<ErrorLimit>>,
    /// Errors to minimise, `max` or `rms`, one fit each; default `max`.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    norms: Norms,
}

impl TryFrom<WidenedFile> for WidenedWant {
    type Error = String;

    fn try_from(file: WidenedFile) -> Result<Self, String> {
        let goals = Goals::read(file.max_ops, file.max_error, file.norms)?;
        let (mean_length, light_radius) = (file.mean_length.0.map(|s| s.0), file.light_radius.0.map(|s| s.0));
        let coat = file.coat.0.unwrap_or(false);
        if mean_length.is_none() && light_radius.is_none() && !coat {
            return Err(
                "nothing widens the lobe; give `mean_length`, `light_radius` or `\"coat\": true`".into()
            );
        }
        Ok(WidenedWant { goals, mean_length, light_radius, coat })
    }
}

/// Fits of the normalisation N that makes E N = 1: N(alpha, mu), of glass N(alpha, mu, ior).
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Fit")]
#[serde(deny_unknown_fields, default, expecting = "an object that describes fits")]
struct FitFile {
    /// Most operations that an emitted fit may take; default: any number.
    max_ops: Maybe<Whole<Ops>>,
    /// Furnace error |E N - 1| that at least one emitted normalisation within `max_ops` must meet,
    /// else the bake fails; default: no limit.
    max_error: Maybe<In<ErrorLimit>>,
    /// Errors to minimise, `max` or `rms`, one fit each; default `max`.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    norms: Norms,
    /// Also fit the average albedo E_avg(alpha); default false. Not of glass.
    average: Maybe<bool>,
    /// Also emit the reciprocal lobe of the light that is lost between facets (Kulla and Conty 2017), and
    /// E_avg, which it takes; default false.
    multiscatter: Maybe<bool>,
    /// Also fit f0 A + B, the albedo for any f0, as one formula of f0; default false. Not of glass.
    blend: Maybe<bool>,
    /// Hypotheses of your own, not of glass: WGSL files, as relative paths from the scene file's folder,
    /// with `/` and without `..`.
    hypotheses: Maybe<List<Text<HypothesisPath>, { limits::HYPOTHESES }>>,
}

impl TryFrom<FitFile> for FitWant {
    type Error = String;

    fn try_from(file: FitFile) -> Result<Self, String> {
        Ok(FitWant {
            goals: Goals::read(file.max_ops, file.max_error, file.norms)?,
            average: file.average.0.unwrap_or(false) || file.multiscatter.0 == Some(true),
            multiscatter: file.multiscatter.0.unwrap_or(false),
            blend: file.blend.0.unwrap_or(false),
            hypotheses: file.hypotheses.0.map_or_else(Vec::new, |l| l.0.into_iter().map(|t| t.0).collect()),
        })
    }
}

impl FitWant {
    /// The first field beside the goals that is asked for: of lobes that only reflect.
    fn of_reflection(&self) -> Option<&'static str> {
        let asked = [
            (self.multiscatter, "multiscatter"),
            (self.average, "average"),
            (self.blend, "blend"),
            (!self.hypotheses.is_empty(), "hypotheses"),
        ];
        asked.into_iter().find(|(is_asked, _)| *is_asked).map(|(_, field)| field)
    }
}

impl TryFrom<WantsFile> for OpenWants {
    type Error = String;

    fn try_from(file: WantsFile) -> Result<Self, String> {
        // A scene with the field is refused where it stands.
        let Maybe::<Renamed>(_) = file.table;
        let (tables, fit) = (file.tables.0.map(|l| l.0), file.fit.0);
        let (exact_fresnel, refracted_width) = (file.exact_fresnel.0, file.refracted_width.0);
        let (widened, is_value) = (file.widened.0, exact_fresnel.is_some() || refracted_width.is_some());
        if fit.is_none() && tables.is_none() && !is_value && widened.is_none() {
            return Err(
                "wants neither `tables` nor `fit` nor `exact_fresnel` nor `refracted_width` nor `widened`; give one of them, or \
                 leave `wants` out for the default"
                    .into(),
            );
        }
        if tables.as_ref().is_some_and(Vec::is_empty) {
            return Err(about("tables", "the list is empty; leave the field out"));
        }
        Ok(OpenWants { tables: tables.unwrap_or_default(), fit, exact_fresnel, refracted_width, widened })
    }
}

impl OpenWants {
    /// What a material with this lobe wants where it does not say: a table, and where the lobe is
    /// isotropic fits.
    pub(super) fn default(lobe: Lobe) -> Result<Self, String> {
        let fit = if lobe == Lobe::Isotropic { Some(FitWant::try_from(FitFile::default())?) } else { None };
        let (tables, widened) = (vec![OpenTable::default()?], None);
        Ok(OpenWants { tables, fit, exact_fresnel: None, refracted_width: None, widened })
    }

    /// The wants of a material with this lobe.
    pub(super) fn of(self, lobe: Lobe) -> Result<Wants, String> {
        if let Some(fit) = self.fit.as_ref().filter(|_| lobe.is_glass()) {
            if lobe == Lobe::AnisotropicGlass {
                return Err(about(
                    "wants.fit",
                    "of anisotropic glass there are tables alone; ask for `wants.tables`",
                ));
            }
            if let Some(field) = fit.of_reflection() {
                return Err(about(format!("wants.fit.{field}"), "it is of lobes that only reflect"));
            }
        }
        let OpenWants { tables, fit, exact_fresnel, refracted_width, widened } = self;
        if refracted_width.is_some() && lobe != Lobe::Glass {
            return Err(about("wants.refracted_width", "it is of glass without anisotropy, which refracts"));
        }
        let tables = different(tables, |table| table.of(lobe), "wants.tables")?;
        Ok(Wants { tables, fit, exact_fresnel, refracted_width, widened })
    }
}

from_file!(FitWant, FitFile);
from_file!(ValueWant, ValueFile);
from_file!(ExactWant, ExactFile);
from_file!(WidenedWant, WidenedFile);
from_file!(OpenWants, WantsFile);
