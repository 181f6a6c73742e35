//! What a material wants of its specular lobe: a table, fits, tables of three axes.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::limits;
use super::material::Lobe;
use super::name::HypothesisPath;
use super::number::{AxisSize, ErrorLimit, In, Numbers, Ops, Whole};
use super::value::{List, Maybe, Text, Word, about, from_file};
use super::volume::{OpenVolume, VolumeWant};
use crate::data::TexelFormat;
pub use crate::data::{Layout, Norm, Serves};

/// The limit on the lookup error where neither size nor limit is given: what a 32x32 (albedo) and a 64x64 (split sum)
/// table in the homogeneous layout reach with room to spare.
fn default_limit(serves: Serves) -> f64 {
    match serves {
        Serves::Albedo => 1e-3,
        Serves::SplitSum => 3e-3,
    }
}

/// A wanted table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableWant {
    /// Columns and rows; `None`: the smallest of 16, 32, 64, 128 squares that meets the limit.
    pub size: Option<[usize; 2]>,
    /// How a texel is stored.
    pub format: TexelFormat,
    /// Coordinates.
    pub layout: Layout,
    /// What it is looked up for.
    pub serves: Serves,
    /// Largest lookup error that the bake may deliver; always given where `size` is `None`.
    pub max_error: Option<f64>,
}

/// Wanted fits.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitWant {
    /// Most operations of a fit; `None`: any.
    pub max_ops: Option<u32>,
    /// Furnace error that at least one emitted normalisation must meet.
    pub max_error: Option<f64>,
    /// Errors to minimise, each once, in the order max, rms.
    pub norms: Vec<Norm>,
    /// Also fit the average albedo E_avg(alpha).
    pub average: bool,
    /// Also fit f0 A + B.
    // Absent where not wanted: the hash of a scene without it is that of the versions before it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub blend: bool,
    /// The user's own hypotheses, relative to the scene file.
    pub hypotheses: Vec<String>,
}

/// At least one of them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Wants {
    /// A table of the isotropic lobe; never of glass.
    pub table: Option<TableWant>,
    /// Fits of the isotropic lobe; never of glass.
    pub fit: Option<FitWant>,
    /// Different tables of three axes, of anisotropic materials and of glass only.
    // Absent where empty: the hash of a scene without them is that of the versions before them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tables: Vec<VolumeWant>,
}

/// Wants as the file has them; what the lobe decides is open.
pub(super) struct OpenWants {
    table: Option<TableWant>,
    fit: Option<FitWant>,
    tables: Vec<OpenVolume>,
}

/// What the material wants of its specular lobe: a table, fits, tables of three axes, or several of them. Without `wants`:
/// a table and fits, with their defaults; of anisotropic materials and of glass, a table of three axes.
#[derive(Deserialize, JsonSchema)]
#[schemars(rename = "Wants", extend("minProperties" = 1))]
#[serde(deny_unknown_fields, expecting = "an object with `table`, `fit` or `tables`")]
struct WantsFile {
    /// A table of the albedo for the shader to look up.
    #[serde(default)]
    table: Maybe<TableWant>,
    /// Formulas for the shader to evaluate.
    #[serde(default)]
    fit: Maybe<FitWant>,
    /// Tables of three axes: of anisotropic materials and of glass.
    #[serde(default)]
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    tables: Maybe<List<OpenVolume, { limits::VOLUMES }>>,
}

/// A table of the albedo. The error of a table is that of its bilinear lookup after rounding to the texel format.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Table")]
#[serde(deny_unknown_fields, default, expecting = "an object that describes a table")]
struct TableFile {
    /// Columns (the mu axis) and rows (the roughness axis). Without it: the smallest of 16x16, 32x32, 64x64, 128x128
    /// that meets `max_error`.
    size: Maybe<Numbers<Whole<AxisSize>, 2, false>>,
    /// Texel format; default `f16`.
    format: Maybe<Word<TexelFormat>>,
    /// Coordinates of the texels; default `homogeneous`.
    layout: Maybe<Word<Layout>>,
    /// What the table is looked up for; default `albedo`.
    serves: Maybe<Word<Serves>>,
    /// Limit on the lookup error; the bake fails where it is exceeded. Default without `size`: 0.001 for `albedo`,
    /// 0.003 for `split-sum`; with `size`: no limit.
    max_error: Maybe<In<ErrorLimit>>,
}

/// Fits of the normalisation N(alpha, mu) that makes E N = 1.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Fit")]
#[serde(deny_unknown_fields, default, expecting = "an object that describes fits")]
struct FitFile {
    /// Most operations that an emitted fit may take; default: any number.
    max_ops: Maybe<Whole<Ops>>,
    /// Furnace error |E N - 1| that at least one emitted normalisation within `max_ops` must meet, else the bake
    /// fails; default: no limit.
    max_error: Maybe<In<ErrorLimit>>,
    /// Errors to minimise, one fit each; default both.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    norms: Maybe<List<Word<Norm>, 2>>,
    /// Also fit the average albedo E_avg(alpha); default false.
    average: Maybe<bool>,
    /// Also fit f0 A + B, the albedo for any f0, as one formula of f0; default false.
    blend: Maybe<bool>,
    /// Hypotheses of your own: WGSL files, as relative paths from the scene file's folder, with `/` and without `..`.
    hypotheses: Maybe<List<Text<HypothesisPath>, { limits::HYPOTHESES }>>,
}

/// The errors to minimise: both where none are given, each once, in the order max, rms.
pub(super) fn norms(given: Option<List<Word<Norm>, 2>>) -> Result<Vec<Norm>, String> {
    let given = given.map_or_else(|| vec![Norm::Max, Norm::Rms], |l| l.0.iter().map(|w| w.0).collect());
    let norms: BTreeSet<Norm> = given.iter().copied().collect();
    if norms.is_empty() {
        return Err(about("norms", "the list is empty; leave the field out for both"));
    }
    if norms.len() != given.len() {
        return Err(about("norms[1]", format!("`{}` is there twice", given[0].name())));
    }
    Ok(norms.into_iter().collect())
}

impl TryFrom<TableFile> for TableWant {
    type Error = String;

    fn try_from(file: TableFile) -> Result<Self, String> {
        let serves = file.serves.0.map_or_else(Serves::default, |w| w.0);
        let size = file.size.0.map(|Numbers([columns, rows])| [columns.0 as usize, rows.0 as usize]);
        let limit = file.max_error.0.map(|e| e.0);
        Ok(TableWant {
            size,
            format: file.format.0.map_or(TexelFormat::F16, |w| w.0),
            layout: file.layout.0.map_or_else(Layout::default, |w| w.0),
            serves,
            max_error: limit.or_else(|| size.is_none().then(|| default_limit(serves))),
        })
    }
}

impl TryFrom<FitFile> for FitWant {
    type Error = String;

    fn try_from(file: FitFile) -> Result<Self, String> {
        Ok(FitWant {
            max_ops: file.max_ops.0.map(|w| w.0),
            max_error: file.max_error.0.map(|e| e.0),
            norms: norms(file.norms.0)?,
            average: file.average.0.unwrap_or(false),
            blend: file.blend.0.unwrap_or(false),
            hypotheses: file.hypotheses.0.map_or_else(Vec::new, |l| l.0.into_iter().map(|t| t.0).collect()),
        })
    }
}

impl TryFrom<WantsFile> for OpenWants {
    type Error = String;

    fn try_from(file: WantsFile) -> Result<Self, String> {
        let (table, fit) = (file.table.0, file.fit.0);
        if table.is_none() && fit.is_none() && file.tables.0.is_none() {
            return Err(
                "wants neither `table` nor `fit` nor `tables`; give one of them, or leave `wants` out for the default"
                    .into(),
            );
        }
        let tables = file.tables.0.map(|l| l.0);
        if tables.as_ref().is_some_and(Vec::is_empty) {
            return Err(about("tables", "the list is empty; leave the field out"));
        }
        Ok(OpenWants { table, fit, tables: tables.unwrap_or_default() })
    }
}

impl OpenWants {
    /// What a material with this lobe wants where it does not say: a table and fits, or a table of three axes.
    pub(super) fn default(lobe: Lobe) -> Result<Self, String> {
        if lobe != Lobe::Isotropic {
            return Ok(OpenWants { table: None, fit: None, tables: vec![OpenVolume::default()?] });
        }
        let table = TableWant::try_from(TableFile::default())?;
        let fit = FitWant::try_from(FitFile::default())?;
        Ok(OpenWants { table: Some(table), fit: Some(fit), tables: Vec::new() })
    }

    /// The wants of a material with this lobe.
    pub(super) fn of(self, lobe: Lobe) -> Result<Wants, String> {
        let OpenWants { table, fit, tables } = self;
        if lobe == Lobe::Isotropic && !tables.is_empty() {
            let message = "they are for anisotropic materials and for glass; give `anisotropy`, or ask for `wants.table`";
            return Err(about("wants.tables", message));
        }
        let isotropic = [("table", table.is_some()), ("fit", fit.is_some())];
        if let Some((field, _)) = isotropic.iter().find(|(_, wanted)| lobe == Lobe::Glass && *wanted) {
            let message = "it is of lobes that only reflect; of glass ask for `wants.tables`";
            return Err(about(format!("wants.{field}"), message));
        }
        let mut volumes: Vec<VolumeWant> = Vec::with_capacity(tables.len());
        for (i, open) in tables.into_iter().enumerate() {
            let volume = open.of(lobe).map_err(|e| about(format!("wants.tables[{i}]"), e))?;
            let same =
                |v: &VolumeWant| (v.layout, v.size, v.format) == (volume.layout, volume.size, volume.format);
            if let Some(first) = volumes.iter().position(same) {
                let message = format!("it has the layout, size and format of wants.tables[{first}]");
                return Err(about(format!("wants.tables[{i}]"), message));
            }
            volumes.push(volume);
        }
        Ok(Wants { table, fit, tables: volumes })
    }
}

from_file!(TableWant, TableFile);
from_file!(FitWant, FitFile);
from_file!(OpenWants, WantsFile);
