//! The one idea of the house: every stand-in for a truth is the same kind of thing.

use serde::{Deserialize, Serialize};

use super::{Certificate, Half, Smith, Table};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::Use;

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
    /// What it is in half precision, where that was measured.
    pub half: Option<Half>,
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
    /// Name of the formula with its norm, or of the table.
    pub name: String,
    /// Quantity it approximates: `ggx-reflection`, ...
    pub quantity: String,
    /// Column of the quantity: `E`, `A`, ...
    pub column: String,
    /// What it is used as.
    pub used_as: Use,
    /// Shadowing form, of a quantity that has one.
    pub smith: Option<Smith>,
    /// The side of the view, of a quantity that has two.
    pub side: Option<Side>,
    /// Where its numbers come from.
    pub source: Source,
    /// Table or formula.
    pub form: Form,
    /// Its measured error.
    pub certificate: Certificate,
    /// What it takes at run time.
    pub cost: Cost,
}
