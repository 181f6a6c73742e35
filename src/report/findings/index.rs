//! The overview of a bake, as plain data.

use super::{EffectFinding, LeftOut, Origin};

/// Everything that a bake made, a line each.
#[derive(Clone, Debug, PartialEq)]
pub struct Index {
    /// What made it.
    pub origin: Origin,
    /// What the scene called for; each effect has a page of its own.
    pub effects: Vec<EffectFinding>,
    /// What it did not.
    pub left_out: Vec<LeftOut>,
    /// Tables and fits.
    pub rows: Vec<IndexRow>,
}

/// A table or a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexRow {
    /// Effect that called for it.
    pub effect: String,
    /// Name.
    pub name: String,
    /// Quantity that it approximates.
    pub quantity: String,
    /// What it is used as.
    pub used_as: String,
    /// Shadowing form.
    pub smith: String,
    /// Largest error in its use.
    pub max_error: Option<f64>,
    /// Operations.
    pub ops: u64,
    /// Texture fetches.
    pub fetches: u64,
    /// Bytes of texels.
    pub bytes: u64,
    /// File of a table; empty for a fit.
    pub file: String,
}
