//! Texels as bytes, for the formats that hold them one after another.

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
                self.stored.write(x, &mut bytes);
            }
        }
        bytes
    }

    /// The stored channels of a file of this table: those of the table, and those that are 0, named
    /// `padding`.
    pub fn channels(&self, table: &Table, file: &[u8]) -> Vec<Channel> {
        let numbers = self.stored.read(file.get(self.header.len()..).unwrap_or_default());
        let channel = |c: usize| Channel {
            name: table.channels.get(c).map_or("padding", |channel| channel.name.as_str()).into(),
            texels: numbers.iter().skip(c).step_by(self.channels).copied().collect(),
        };
        (0..self.channels).map(channel).collect()
    }
}
