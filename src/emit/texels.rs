//! Texels as bytes, for the formats that hold them one after another.

use half::f16;

use super::texture::Field;
use crate::data::{Channel, Table, TexelFormat};

/// How a file holds the texels of a table one after another: little-endian, columns fastest, then
/// rows, then slices, the channels of a texel together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Packed {
    /// Everything before the first texel.
    pub header: Vec<u8>,
    /// The numbers among it that have a name, one after another, and the byte of the first.
    pub fields: (usize, Vec<Field>),
    /// Type of a stored number.
    pub stored: TexelFormat,
    /// Numbers of a stored texel: its channels, and zeros after them.
    pub channels: usize,
}

impl Packed {
    /// The file of a table.
    pub fn file(&self, table: &Table) -> Vec<u8> {
        let texels = table.size().iter().product();
        let mut bytes = self.header.clone();
        bytes.reserve(texels * self.channels * self.stored.bytes() as usize);
        for i in 0..texels {
            for c in 0..self.channels {
                let x = table.channels.get(c).map_or(0.0, |channel| table.format.quantise(channel.texels[i]));
                match self.stored {
                    TexelFormat::Unorm8 => bytes.push((255.0 * x).round() as u8),
                    TexelFormat::Unorm16 => bytes.extend(((65535.0 * x).round() as u16).to_le_bytes()),
                    TexelFormat::F16 => bytes.extend(f16::from_f64(x).to_le_bytes()),
                    TexelFormat::F32 => bytes.extend((x as f32).to_le_bytes()),
                }
            }
        }
        bytes
    }

    /// The stored channels of a file of this table: those of the table, and those that are 0, named
    /// `padding`.
    pub fn channels(&self, table: &Table, file: &[u8]) -> Vec<Channel> {
        let texels = file.get(self.header.len()..).unwrap_or_default();
        let numbers: Vec<f64> = match self.stored {
            TexelFormat::Unorm8 => texels.iter().map(|b| f64::from(*b) / 255.0).collect(),
            TexelFormat::Unorm16 => {
                texels.as_chunks().0.iter().map(|b| f64::from(u16::from_le_bytes(*b)) / 65535.0).collect()
            }
            TexelFormat::F16 => {
                texels.as_chunks().0.iter().map(|b| f16::from_le_bytes(*b).to_f64()).collect()
            }
            TexelFormat::F32 => texels.as_chunks().0.iter().map(|b| f32::from_le_bytes(*b).into()).collect(),
        };
        let channel = |c: usize| Channel {
            name: table.channels.get(c).map_or("padding", |channel| channel.name.as_str()).into(),
            texels: numbers.iter().skip(c).step_by(self.channels).copied().collect(),
        };
        (0..self.channels).map(channel).collect()
    }
}
