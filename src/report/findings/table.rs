//! A table as the page shows it.

use serde::Serialize;

use crate::data::{AlphaMap, Axis, Place, Smith, TexelFormat};
use crate::report::Field;

/// A table with its errors.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableFinding {
    /// Name of the table.
    pub name: String,
    /// Its files relative to the bake's folder, one for each container, with their sidecars.
    pub files: Vec<String>,
    /// Quantity that it samples.
    pub quantity: String,
    /// Shadowing form, of a quantity that has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smith: Option<Smith>,
    /// How roughness becomes alpha.
    pub alpha_map: AlphaMap,
    /// Columns, rows, slices, as far as there are any.
    pub axes: Vec<Axis>,
    /// Channels in the order of the file.
    pub channels: Vec<ChannelFinding>,
    /// How values follow from the channels.
    pub decode: String,
    /// What the axes do not tell of the nodes; may be empty.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub note: String,
    /// How a texel is stored.
    pub format: TexelFormat,
    /// Bytes of all texels.
    pub bytes: u64,
    /// Operations of a lookup beside its fetch.
    pub ops: u32,
    /// Integrand evaluations of its texels; 0 where they are not counted.
    #[serde(skip_serializing_if = "is_zero")]
    pub evaluations: u64,
    /// Errors by their causes, in the order of the page: what each is of, and its size.
    pub errors: Vec<(String, ErrorFigure)>,
    /// Signed error of the lookup of the quantised texels, over roughness and mu: a map for each
    /// value, or for each slice shown.
    pub lookup_error: Vec<Field>,
}

fn is_zero(n: &u64) -> bool {
    *n == 0
}

/// A channel of a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChannelFinding {
    /// Name in the file.
    pub name: String,
    /// Texels as stored, row by row, first row at the top; for the picture only, the file holds
    /// them.
    #[serde(skip)]
    pub texels: Vec<f64>,
}

/// Size of an error and where it is largest.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorFigure {
    /// Largest magnitude.
    pub max: f64,
    /// Root of the mean square; none for a bound.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rms: Option<f64>,
    /// Where the largest is.
    pub at: Place,
}
