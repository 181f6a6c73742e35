//! Headerless little-endian f32: for readers that take nothing else. A sidecar says what they are.

use super::texels::Packed;
use crate::data::{Table, TexelFormat};

/// How a file holds a validated table: the f32 values of its quantised texels, columns (x) fastest,
/// then rows, then slices, the channels of a texel together.
pub fn packed(table: &Table) -> Packed {
    Packed {
        header: Vec::new(),
        fields: (0, Vec::new()),
        stored: TexelFormat::F32,
        channels: table.channels.len(),
    }
}
