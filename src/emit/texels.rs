//! Texels as bytes, for the formats that hold them one after another.

use half::f16;

use crate::data::{Table, TexelFormat};

/// The quantised texels as little-endian numbers of `stored`: columns fastest, then rows, then
/// slices, the channels of a texel together, with zeros after them up to `channels`.
pub(super) fn interleaved(table: &Table, stored: TexelFormat, channels: usize) -> Vec<u8> {
    let texels = table.size().iter().product();
    let mut bytes = Vec::with_capacity(texels * channels * stored.bytes() as usize);
    for i in 0..texels {
        for c in 0..channels {
            let x = table.channels.get(c).map_or(0.0, |channel| table.format.quantise(channel.texels[i]));
            match stored {
                TexelFormat::F16 => bytes.extend(f16::from_f64(x).to_le_bytes()),
                TexelFormat::F32 => bytes.extend((x as f32).to_le_bytes()),
            }
        }
    }
    bytes
}
