//! Headers of little-endian words, and texels that lie one after another.

use crate::foreign::{Channel, ForeignError, RawFormat, Spot, Step};
use lobefit_math::srgb;

/// How the numbers of a texel are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stored {
    /// Each in bytes of its own.
    Apart(RawFormat),
    /// Red, green and blue, from the lowest bit of a word on, as floats of five bits of exponent and these
    /// bits of mantissa, without a sign.
    Floats([u32; 3]),
}

/// A format of texels: the numbers of a texel and how each is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pixels {
    /// How its numbers are stored.
    pub stored: Stored,
    /// Its channels in the order of their bytes: `RGBA`, `BGRA`.
    pub order: &'static str,
    /// A texture unit decodes the colours, not alpha, from sRGB, and so does this reader.
    pub srgb: bool,
}

impl Pixels {
    /// Linear values.
    pub const fn of(format: RawFormat, order: &'static str) -> Pixels {
        Pixels { stored: Stored::Apart(format), order, srgb: false }
    }

    /// Floats of 11, 11 and 10 bits in a word.
    pub const fn r11g11b10() -> Pixels {
        Pixels { stored: Stored::Floats([6, 6, 5]), order: "RGB", srgb: false }
    }

    /// Bytes of a texel.
    pub fn bytes(self) -> usize {
        match self.stored {
            Stored::Apart(format) => self.order.len() * format.bytes(),
            Stored::Floats(_) => 4,
        }
    }

    /// The step of its values: of several that of most channels, which is the finest.
    pub fn step(self) -> Step {
        match self.stored {
            Stored::Apart(_) if self.srgb => Step::Srgb(255),
            Stored::Apart(format) => format.step(),
            Stored::Floats([red, ..]) => Step::Small(red),
        }
    }

    /// In words: `f16`, `unorm8 decoded from sRGB, which its format names`.
    pub fn words(self) -> String {
        let srgb = if self.srgb { " decoded from sRGB, which its format names" } else { "" };
        match self.stored {
            Stored::Apart(format) => format!("{}{srgb}", format.name()),
            Stored::Floats([6, 6, 5]) => "R11G11B10 float".into(),
            Stored::Floats(bits) => format!("floats of {bits:?} bits of mantissa"),
        }
    }

    /// The channels of texels, named and in the order red, green, blue, alpha.
    pub fn channels(self, bytes: &[u8]) -> Vec<Channel> {
        let count = self.order.len();
        "RGBA"
            .chars()
            .filter_map(|name| Some((name, self.order.find(name)?)))
            .map(|(name, c)| Channel {
                name: name.to_string(),
                values: match self.stored {
                    Stored::Apart(format) if self.srgb && name != 'A' => {
                        format.every(bytes, c, count).into_iter().map(srgb::decoded).collect()
                    }
                    Stored::Apart(format) => format.every(bytes, c, count),
                    Stored::Floats(bits) => floats(bytes, bits, c),
                }
                .into(),
            })
            .collect()
    }
}

/// Bits of the exponent of a small float, as of a half, whose infinity is its largest.
const EXPONENT: u32 = 5;

/// One of the floats of every word.
fn floats(bytes: &[u8], mantissas: [u32; 3], which: usize) -> Vec<f64> {
    let below: u32 = mantissas[..which].iter().map(|bits| bits + EXPONENT).sum();
    let bits = mantissas[which];
    let one = |word: &[u8; 4]| {
        let float = u32::from_le_bytes(*word) >> below & ((1 << (bits + EXPONENT)) - 1);
        // The half with the same exponent and mantissa, from its highest bit on.
        half::f16::from_bits((float << (10 - bits)) as u16).to_f64()
    };
    bytes.as_chunks::<4>().0.iter().map(one).collect()
}

/// The bytes of a file, read with bounds.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub bytes: &'a [u8],
    pub file: &'a str,
}

impl<'a> Source<'a> {
    /// `length` bytes from `at`; `what` they are, for the message if they are not there.
    pub fn part(self, at: u64, length: u64, what: &str) -> Result<&'a [u8], ForeignError> {
        let found = self.bytes.len() as u64;
        let end = at.checked_add(length).filter(|end| *end <= found);
        let short = || {
            let left = found.saturating_sub(at);
            let message = format!("{what} would take {length} bytes, {left} are left: the file is cut short");
            self.malformed(at, message)
        };
        Ok(&self.bytes[at as usize..end.ok_or_else(short)? as usize])
    }

    /// Little-endian words of 32 bits from `at`.
    pub fn words<const N: usize>(self, at: u64, what: &str) -> Result<[u32; N], ForeignError> {
        let part = self.part(at, 4 * N as u64, what)?;
        let mut words = [0; N];
        for (word, bytes) in words.iter_mut().zip(part.as_chunks::<4>().0) {
            *word = u32::from_le_bytes(*bytes);
        }
        Ok(words)
    }

    /// The error that what stands at a byte contradicts the format.
    pub fn malformed(self, at: u64, message: impl Into<String>) -> ForeignError {
        ForeignError::at(self.file, Spot::Byte(at), message)
    }

    /// The error that what stands at a byte is a kind of file that is not read.
    pub fn unsupported(self, at: u64, what: impl AsRef<str>, advice: &str) -> ForeignError {
        ForeignError::unsupported(self.file, Spot::Byte(at), what.as_ref(), advice)
    }
}

/// What to do with a format that is not read.
pub(super) const CONVERT: &str =
    "export it as R, RG, RGB or RGBA of 8 or 16 bit unorm, 16 or 32 bit float, or as R11G11B10 float";
