//! The one idea of the house: every stand-in for a truth is the same kind of thing.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Certificate, Smith, Table};

/// Run-time cost by the project's operation model.
///
/// add, mul, fma, min, max, compare, select 1; rcp, sqrt, exp2 4; a division is rcp + mul; exp 5,
/// pow 9; saturate, negate 0; common subexpressions once; a mul fuses into a following add;
/// roughness and alpha are both given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cost {
    /// Weighted arithmetic operations.
    pub ops: u32,
    /// Texture fetches.
    pub fetches: u32,
    /// Bytes of texels to keep resident.
    pub bytes: u64,
}

/// What an approximation is used as; the error metric follows from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Use {
    /// As the value itself: error |f - truth|.
    Value,
    /// As N with E N = 1: the furnace error |E N - 1|.
    Normalisation,
    /// As f0 A + B for every f0 in [0, 1]: error max(|error of E|, |error of B|).
    F0Blend,
    /// As a diffuse coupling factor.
    Coupling,
    /// As an adjusted roughness.
    Parallax,
}

impl Use {
    /// All of them.
    pub const ALL: [Use; 5] = [Use::Value, Use::Normalisation, Use::F0Blend, Use::Coupling, Use::Parallax];

    /// The word used in the manifest.
    pub fn name(self) -> &'static str {
        match self {
            Use::Value => "value",
            Use::Normalisation => "normalisation",
            Use::F0Blend => "f0-blend",
            Use::Coupling => "coupling",
            Use::Parallax => "parallax",
        }
    }

    /// What its error is.
    pub fn metric(self) -> &'static str {
        match self {
            Use::Value => "absolute error",
            Use::Normalisation => "furnace error |E N - 1|",
            Use::F0Blend => "error of f0 A + B, for the worst f0",
            Use::Coupling => "error of the coupling factor",
            Use::Parallax => "relative error of the adjusted alpha",
        }
    }
}

/// Where the numbers of an approximation come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// Computed by this program.
    Fitted,
    /// Published constants, with the publication.
    Published(String),
}

impl Source {
    /// `fitted`, or the publication.
    pub fn text(&self) -> &str {
        match self {
            Source::Fitted => "fitted",
            Source::Published(publication) => publication,
        }
    }
}

/// A formula with its coefficients filled in.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    /// Name of the hypothesis, without its extension.
    pub hypothesis: String,
    /// Argument names in order.
    pub inputs: Vec<String>,
    /// Coefficients by parameter name, in the order of declaration, rounded to f32.
    pub coefficients: Vec<(String, f32)>,
    /// Norm that the coefficients minimise: `max`, `rms`, or `published`.
    pub norm: String,
}

/// What an approximation is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// Texels to look up.
    Table(Table),
    /// A formula to evaluate.
    Formula(Formula),
}

/// A stand-in for a quantity, measured: ours or somebody else's, table or formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Approximation {
    /// Name: the function in the emitted code, or the table's.
    pub name: String,
    /// Quantity it approximates: `ggx-reflection`, ...
    pub quantity: String,
    /// Column of the quantity: `E`, `A`, ...
    pub column: String,
    /// What it is used as.
    pub used_as: Use,
    /// Shadowing form, of a quantity that has one.
    pub smith: Option<Smith>,
    /// Where its numbers come from.
    pub source: Source,
    /// Table or formula.
    pub form: Form,
    /// Its measured error.
    pub certificate: Certificate,
    /// What it takes at run time.
    pub cost: Cost,
}
