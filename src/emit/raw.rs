//! Headerless little-endian f32: for readers that take nothing else. A sidecar says what they are.

use super::texels::interleaved;
use crate::data::{Table, TexelFormat};

/// The bytes of a validated table: the f32 values of its quantised texels, columns (x) fastest,
/// then rows, then slices, the channels of a texel together.
pub fn encode(table: &Table) -> Vec<u8> {
    interleaved(table, TexelFormat::F32, table.channels.len())
}
