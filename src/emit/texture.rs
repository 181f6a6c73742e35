//! What the containers that hold textures as graphics interfaces take them have in common: sizes of
//! 32 bits, one, two or four channels, texels tightly packed.

use super::texels::Packed;
use crate::data::{Container, Table, TexelFormat};

/// A table that a texture file cannot hold.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TextureError {
    /// Not one to four channels.
    #[error("table {table}: {channels} channels; a texel of {} has one to four: ask for exr, npy or raw", .container.name())]
    Channels {
        /// Format of the file.
        container: Container,
        /// Table's name.
        table: String,
        /// Its channels.
        channels: usize,
    },
    /// A size that does not fit the header's 32 bits.
    #[error("table {table}: size {size:?} exceeds what the header of {} can state: ask for exr, npy or raw", .container.name())]
    Size {
        /// Format of the file.
        container: Container,
        /// Table's name.
        table: String,
        /// Columns, rows, slices.
        size: [usize; 3],
    },
}

/// A stored texel. Three channels are stored as four, the fourth 0: graphics interfaces need not have
/// formats of three halves, nor filter those of three singles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texel {
    /// Type of a channel.
    pub format: TexelFormat,
    /// Stored channels: 1, 2 or 4.
    pub channels: u32,
}

impl Texel {
    /// Of a table; none for more channels than four, or for no channel.
    pub fn of(table: &Table) -> Option<Texel> {
        let channels = match table.channels.len() {
            1 => 1,
            2 => 2,
            3 | 4 => 4,
            _ => return None,
        };
        Some(Texel { format: table.format, channels })
    }

    /// Bytes of a channel.
    pub fn channel_bytes(self) -> u32 {
        self.format.bytes() as u32
    }

    /// Bytes of a texel.
    pub fn bytes(self) -> u32 {
        self.channels * self.channel_bytes()
    }

    /// The one of 12 formats that an interface has for it, of one, two and four channels of each type
    /// as [`TexelFormat`] lists them.
    pub fn named<T: Copy>(self, formats: [[T; 3]; 4]) -> T {
        formats[self.format as usize][(self.channels / 2) as usize]
    }
}

/// A number of a header with the name that its format's specification gives it.
pub type Field = (&'static str, u32);

/// A table as a texture file states it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Texture {
    /// Columns, rows, slices.
    pub size: [u32; 3],
    /// Whether it is a 3-D texture.
    pub solid: bool,
    /// Format of its texels.
    pub texel: Texel,
    /// Bytes of a row.
    pub pitch: u32,
}

impl Texture {
    /// # Errors
    /// More channels than four, an axis longer than 2^32 - 1 or a row of as many bytes.
    pub fn new(table: &Table, container: Container) -> Result<Texture, TextureError> {
        let (name, size) = (|| table.name.clone(), table.size());
        let number =
            |n: usize| u32::try_from(n).map_err(|_| TextureError::Size { container, table: name(), size });
        let channels = table.channels.len();
        let none = || TextureError::Channels { container, table: name(), channels };
        let texel = Texel::of(table).ok_or_else(none)?;
        Ok(Texture {
            size: [number(size[0])?, number(size[1])?, number(size[2])?],
            solid: table.axes.len() >= 3,
            texel,
            pitch: number(size[0].saturating_mul(texel.bytes() as usize))?,
        })
    }

    /// A file that opens with `magic`, the words of `fields` and `rest`.
    pub fn packed(&self, magic: &[u8], fields: Vec<Field>, rest: &[u8]) -> Packed {
        let words: Vec<u8> = fields.iter().flat_map(|(_, word)| word.to_le_bytes()).collect();
        Packed {
            header: [magic, &words, rest].concat(),
            fields: (magic.len(), fields),
            stored: self.texel.format,
            channels: self.texel.channels as usize,
        }
    }
}
