//! A table as the page shows it.

use serde::Serialize;

use crate::data::{AlphaMap, Axis, Place, Smith, TexelFormat};
use crate::report::Field;

/// A table with its errors.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableFinding {
    /// Name of the table.
    pub name: String,
    /// File, relative to the bake's folder.
    pub file: String,
    /// Quantity that it samples.
    pub quantity: String,
    /// Shadowing form.
    pub smith: Smith,
    /// How roughness becomes alpha.
    pub alpha_map: AlphaMap,
    /// Columns, then rows.
    pub axes: Vec<Axis>,
    /// How a texel is stored.
    pub format: TexelFormat,
    /// Bytes of all texels.
    pub bytes: u64,
    /// Channels in the order of the file.
    pub channels: Vec<ChannelFinding>,
    /// Errors told apart, in the order of the page: what each is of, and its size.
    pub errors: Vec<(String, ErrorFigure)>,
    /// Signed error of the lookup of the quantised texels, over physical inputs: one map per looked-up value.
    pub lookup_error: Vec<Field>,
}

/// A channel of a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChannelFinding {
    /// Name in the file.
    pub name: String,
    /// Texels as stored, row by row, first row at the top; for the picture only, the file holds them.
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
