//! DirectDraw surfaces with the extended header of Direct3D 10: a 3-D texture, or a 2-D texture for
//! two axes, one level, texels tightly packed.
//!
//! Layout and values: Microsoft, "Programming guide for DDS", "DDS_HEADER", "DDS_HEADER_DXT10".

use super::texels::interleaved;
use crate::data::{Table, TexelFormat};

/// A table that a DDS file cannot hold.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DdsError {
    /// Not one to four channels.
    #[error("table {table}: {channels} channels; a DDS texel has one to four: ask for exr, npy or raw")]
    Channels {
        /// Table's name.
        table: String,
        /// Its channels.
        channels: usize,
    },
    /// A size that does not fit the header's 32 bits.
    #[error("table {table}: size {size:?} exceeds what a DDS header can state: ask for exr, npy or raw")]
    Size {
        /// Table's name.
        table: String,
        /// Columns, rows, slices.
        size: [usize; 3],
    },
}

/// Bytes before the first texel: magic number, header and its extension.
pub const OFFSET: usize = 4 + 124 + 20;

/// DDSD_CAPS, _HEIGHT, _WIDTH, _PITCH, _PIXELFORMAT, _MIPMAPCOUNT: the fields of the header that
/// hold.
const FLAGS: u32 = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000 | 0x2_0000;

/// DDSD_DEPTH.
const FLAG_DEPTH: u32 = 0x80_0000;

/// DDSCAPS_TEXTURE.
const CAPS: u32 = 0x1000;

/// DDSCAPS2_VOLUME.
const CAPS_VOLUME: u32 = 0x20_0000;

/// DDPF_FOURCC, and the code that announces the extension.
const PIXEL_FOURCC: u32 = 0x4;
const FOURCC: [u8; 4] = *b"DX10";

/// D3D10_RESOURCE_DIMENSION_TEXTURE2D and _TEXTURE3D.
const DIMENSIONS: [u32; 2] = [3, 4];

/// Channels of a stored texel: three become four, the fourth 0, since DXGI has no format of three
/// halves and graphics interfaces need not filter its format of three singles.
pub fn stored_channels(table: &Table) -> usize {
    match table.channels.len() {
        3 => 4,
        n => n,
    }
}

/// The DXGI_FORMAT of a table by name and number; none for more channels than four.
pub fn format(table: &Table) -> Option<(&'static str, u32)> {
    match (table.format, stored_channels(table)) {
        (TexelFormat::F16, 1) => Some(("R16_FLOAT", 54)),
        (TexelFormat::F16, 2) => Some(("R16G16_FLOAT", 34)),
        (TexelFormat::F16, 4) => Some(("R16G16B16A16_FLOAT", 10)),
        (TexelFormat::F32, 1) => Some(("R32_FLOAT", 41)),
        (TexelFormat::F32, 2) => Some(("R32G32_FLOAT", 16)),
        (TexelFormat::F32, 4) => Some(("R32G32B32A32_FLOAT", 2)),
        _ => None,
    }
}

/// The bytes of a validated table, columns (x) fastest, then rows, then slices.
///
/// Errors: more channels than four, an axis longer than 2^32 - 1 or a row of as many bytes.
pub fn encode(table: &Table) -> Result<Vec<u8>, DdsError> {
    let channels = stored_channels(table);
    let none = || DdsError::Channels { table: table.name.clone(), channels: table.channels.len() };
    let (_, format) = format(table).ok_or_else(none)?;
    let size = table.size();
    let number = |n: usize| u32::try_from(n).map_err(|_| DdsError::Size { table: table.name.clone(), size });
    let [width, height, depth] = [number(size[0])?, number(size[1])?, number(size[2])?];
    let pitch = number(size[0].saturating_mul(channels * table.format.bytes() as usize))?;
    let solid = table.axes.len() == 3;
    let (flags, caps2) = if solid { (FLAGS | FLAG_DEPTH, CAPS_VOLUME) } else { (FLAGS, 0) };
    let mut words = vec![124, flags, height, width, pitch, if solid { depth } else { 0 }, 1];
    words.extend([0; 11]);
    words.extend([32, PIXEL_FOURCC, u32::from_le_bytes(FOURCC), 0, 0, 0, 0, 0]);
    words.extend([CAPS, caps2, 0, 0, 0]);
    // Format, dimension, no cube, one texture, meaning of alpha not stated.
    words.extend([format, DIMENSIONS[usize::from(solid)], 0, 1, 0]);
    let mut bytes = b"DDS ".to_vec();
    bytes.extend(words.into_iter().flat_map(u32::to_le_bytes));
    bytes.extend(interleaved(table, table.format, channels));
    Ok(bytes)
}
