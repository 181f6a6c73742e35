//! What a material wants of its specular lobe: a table, a fit, or both.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::limits;
use super::name::HypothesisPath;
use super::number::{AxisSize, ErrorLimit, In, Numbers, Ops, Whole};
use super::value::{List, Maybe, Text, Word, from_file};
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
    /// The user's own hypotheses, relative to the scene file.
    pub hypotheses: Vec<String>,
}

/// A table, a fit, or both; never neither.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Wants {
    /// A table.
    pub table: Option<TableWant>,
    /// Fits.
    pub fit: Option<FitWant>,
}

/// What the material wants of its specular lobe: a table, a fit, or both. Without `wants`: both, with their defaults.
#[derive(Deserialize, JsonSchema)]
#[schemars(rename = "Wants", extend("minProperties" = 1))]
#[serde(deny_unknown_fields, expecting = "an object with `table`, `fit` or both")]
struct WantsFile {
    /// A table of the albedo for the shader to look up.
    #[serde(default)]
    table: Maybe<TableWant>,
    /// Formulas for the shader to evaluate.
    #[serde(default)]
    fit: Maybe<FitWant>,
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
    /// Hypotheses of your own: WGSL files, as relative paths from the scene file's folder, with `/` and without `..`.
    hypotheses: Maybe<List<Text<HypothesisPath>, { limits::HYPOTHESES }>>,
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
        let given =
            file.norms.0.map_or_else(|| vec![Norm::Max, Norm::Rms], |l| l.0.iter().map(|w| w.0).collect());
        let norms: BTreeSet<Norm> = given.iter().copied().collect();
        if norms.is_empty() {
            return Err("norms: the list is empty; leave the field out for both".into());
        }
        if norms.len() != given.len() {
            return Err(format!("norms: `{}` is there twice", given[0].name()));
        }
        Ok(FitWant {
            max_ops: file.max_ops.0.map(|w| w.0),
            max_error: file.max_error.0.map(|e| e.0),
            norms: norms.into_iter().collect(),
            average: file.average.0.unwrap_or(false),
            hypotheses: file.hypotheses.0.map_or_else(Vec::new, |l| l.0.into_iter().map(|t| t.0).collect()),
        })
    }
}

impl TryFrom<WantsFile> for Wants {
    type Error = String;

    fn try_from(file: WantsFile) -> Result<Self, String> {
        match (file.table.0, file.fit.0) {
            (None, None) => {
                Err("wants neither `table` nor `fit`; give one of them, or leave `wants` out for both".into())
            }
            (table, fit) => Ok(Wants { table, fit }),
        }
    }
}

impl Wants {
    /// Both, with the defaults of every field.
    pub(super) fn both() -> Result<Wants, String> {
        Ok(Wants {
            table: Some(TableWant::try_from(TableFile::default())?),
            fit: Some(FitWant::try_from(FitFile::default())?),
        })
    }
}

from_file!(TableWant, TableFile);
from_file!(FitWant, FitFile);
from_file!(Wants, WantsFile);
