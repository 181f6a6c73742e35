//! The sheen layer of a material, and what is wanted of it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::number::{ErrorLimit, In, Ops, Span, Unit, Whole};
use super::value::{List, Maybe, Word, from_file};
use super::wants::norms;
use crate::data::Norm;

/// A sheen layer: the lobe of Estevez and Kulla (2017).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sheen {
    /// Roughness range in [0, 1], lo <= hi; the scene's map makes alpha of it.
    pub roughness: [f64; 2],
    /// Most operations of a fit; `None`: any.
    pub max_ops: Option<u32>,
    /// Error of E that at least one emitted fit must meet.
    pub max_error: Option<f64>,
    /// Errors to minimise, each once, in the order max, rms.
    pub norms: Vec<Norm>,
}

/// A sheen layer, as of cloth (the lobe of Estevez and Kulla 2017), which calls for fits of its albedo E. At grazing E exceeds 1,
/// the more the smaller its alpha is.
#[derive(Deserialize, JsonSchema)]
#[schemars(rename = "Sheen")]
#[serde(deny_unknown_fields, expecting = "an object that describes a sheen layer")]
struct SheenFile {
    /// Roughness of the sheen: a number, or the range [lo, hi] that the material's texture spans. Where alpha is below 0.0001 it
    /// calls for nothing.
    roughness: Span<Unit, true>,
    /// Most operations that an emitted fit may take; default: any number.
    #[serde(default)]
    max_ops: Maybe<Whole<Ops>>,
    /// Error of E that at least one emitted fit within `max_ops` must meet, else the bake fails; default: no limit.
    #[serde(default)]
    max_error: Maybe<In<ErrorLimit>>,
    /// Errors to minimise, one fit each; default both.
    #[serde(default)]
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    norms: Maybe<List<Word<Norm>, 2>>,
}

impl TryFrom<SheenFile> for Sheen {
    type Error = String;

    fn try_from(file: SheenFile) -> Result<Self, String> {
        Ok(Sheen {
            roughness: file.roughness.0,
            max_ops: file.max_ops.0.map(|w| w.0),
            max_error: file.max_error.0.map(|e| e.0),
            norms: norms(file.norms.0)?,
        })
    }
}

from_file!(Sheen, SheenFile);
