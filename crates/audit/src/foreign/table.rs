//! What a file holds, as plain values.

use std::sync::Arc;

use half::f16;
use lobefit_math::{ops, srgb};

/// How finely a format can tell values apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// f32 or f64: finer than anything that is asked here.
    None,
    /// IEEE half.
    Half,
    /// Floats of the exponents of halves with so many bits of mantissa, without a sign.
    Small(u32),
    /// Integers of so many bits over the largest.
    Unorm(u32),
    /// Mantissas of 8 bits under the exponent of the largest of three.
    Rgbe,
    /// Integers over this many, decoded from sRGB.
    Srgb(u32),
    /// Integers over this many, decoded by a power, in tenths.
    Gamma(u32, u32),
    /// Integers / 255 that hold (value alpha)^(1/gamma), decoded; gamma in tenths.
    Rgbd(u32),
    /// Printed with this many digits after the decimal point.
    Decimals(u32),
}

/// The least normal number of halves, and of the smaller floats of their exponents: 2^-14.
const SMALLEST: f64 = 1.0 / 16384.0;

impl Step {
    /// Half the distance between neighbours of the format near `x`: what rounding to nearest may
    /// have done to a value that is stored as x. 0 for [`Step::None`].
    pub fn rounding(self, x: f64) -> f64 {
        match self {
            Step::None => 0.0,
            // Halves have 11 significant bits down to 2^-14, and one spacing, 2^-24, below.
            Step::Half => {
                let bits = f16::from_f64(x.abs()).to_bits();
                let next = f16::from_bits(bits.saturating_add(1));
                let gap = next.to_f64() - f16::from_bits(bits).to_f64();
                if gap.is_finite() { 0.5 * gap } else { 16.0 }
            }
            // One more significant bit than are stored, down to 2^-14, and one spacing below.
            Step::Small(bits) => 0.5 * ops::exp2(ops::log2(x.abs().max(SMALLEST)).floor() - f64::from(bits)),
            Step::Unorm(bits) => 0.5 / f64::from((1_u32 << bits) - 1),
            // Of the largest of the three: what is known of one alone.
            Step::Rgbe if x == 0.0 => 0.0,
            Step::Rgbe => 0.5 * ops::exp2(ops::log2(x.abs()).floor() - 7.0),
            // A step of what is stored is longest, after decoding, above the value.
            Step::Srgb(n) => srgb::decoded(srgb::encoded(x) + 0.5 / f64::from(n)) - x,
            Step::Gamma(n, tenths) => {
                let gamma = f64::from(tenths) / 10.0;
                ops::pow(ops::pow(x.abs(), gamma.recip()) + 0.5 / f64::from(n), gamma) - x.abs()
            }
            // With the alpha that one channel alone calls for.
            Step::Rgbd(tenths) => {
                let (gamma, alpha) = (f64::from(tenths) / 10.0, x.abs().max(1.0).recip());
                let stored = ops::pow(x.abs() * alpha, gamma.recip());
                ops::pow(stored + 0.5 / 255.0, gamma) / alpha - x.abs()
            }
            Step::Decimals(n) => (0..n).fold(0.5, |step, _| step / 10.0),
        }
    }

    /// The step in words: `half`, `6 decimals`.
    pub fn text(self) -> String {
        match self {
            Step::None => "single or better".into(),
            Step::Half => "half".into(),
            Step::Small(bits) => format!("floats of {bits} bits of mantissa"),
            Step::Unorm(bits) => format!("{bits}-bit unorm"),
            Step::Rgbe => "RGBE".into(),
            Step::Srgb(n) => format!("{}-bit sRGB", (n + 1).ilog2()),
            Step::Gamma(n, tenths) => format!("{}-bit gamma {}", (n + 1).ilog2(), f64::from(tenths) / 10.0),
            Step::Rgbd(_) => "8-bit RGBD".into(),
            Step::Decimals(n) => format!("{n} decimals"),
        }
    }
}

/// One channel of a table, or of a sampled function.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Its name in the file; `0`, `1`, ... where the file names none.
    pub name: String,
    /// As many finite values as the product of the table's sizes, x fastest, in the file's order of
    /// rows; shared, as tables of a file may be large.
    pub values: Arc<Vec<f64>>,
}

impl Channel {
    /// Whether its values are not all the same.
    pub(crate) fn varies(&self) -> bool {
        self.values.iter().any(|v| *v != self.values[0])
    }
}

/// A table as a file holds it.
#[derive(Clone, Debug, PartialEq)]
pub struct ForeignTable {
    /// File as the caller named it.
    pub file: String,
    /// Name of the array or layer; empty where the file names none.
    pub name: String,
    /// What it is, in words: `EXR, 64 x 64, half, channels R G`.
    pub what: String,
    /// Texels along each axis, x fastest; one to three axes.
    pub size: Vec<usize>,
    /// At least one.
    pub channels: Vec<Channel>,
    /// What the format rounds values to.
    pub step: Step,
    /// What the file says of itself: the attribute `lobefit` of an EXR layer that this tool wrote,
    /// or the sidecar of another file that it wrote; empty in all others.
    pub note: String,
}

impl ForeignTable {
    /// Texels of a channel.
    pub fn texels(&self) -> usize {
        self.size.iter().product()
    }
}

/// How numbers lie in a file that does not say so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RawFormat {
    /// IEEE half, little-endian.
    F16,
    /// IEEE single, little-endian.
    F32,
    /// IEEE double, little-endian.
    F64,
    /// Bytes / 255.
    Unorm8,
    /// 16-bit little-endian integers / 65535.
    Unorm16,
}

impl RawFormat {
    /// All of them.
    pub const ALL: [RawFormat; 5] =
        [RawFormat::F16, RawFormat::F32, RawFormat::F64, RawFormat::Unorm8, RawFormat::Unorm16];

    /// The word for it in options and messages.
    pub fn name(self) -> &'static str {
        match self {
            RawFormat::F16 => "f16",
            RawFormat::F32 => "f32",
            RawFormat::F64 => "f64",
            RawFormat::Unorm8 => "unorm8",
            RawFormat::Unorm16 => "unorm16",
        }
    }

    /// Bytes of one value.
    pub fn bytes(self) -> usize {
        match self {
            RawFormat::Unorm8 => 1,
            RawFormat::F16 | RawFormat::Unorm16 => 2,
            RawFormat::F32 => 4,
            RawFormat::F64 => 8,
        }
    }

    /// Its step.
    pub fn step(self) -> Step {
        match self {
            RawFormat::F16 => Step::Half,
            RawFormat::F32 | RawFormat::F64 => Step::None,
            RawFormat::Unorm8 => Step::Unorm(8),
            RawFormat::Unorm16 => Step::Unorm(16),
        }
    }

    /// The values of little-endian bytes; bytes after the last whole value are left out.
    pub(super) fn values(self, bytes: &[u8]) -> Vec<f64> {
        self.every(bytes, 0, 1)
    }

    /// One number of each texel of `count`, from the place `first`.
    pub(super) fn every(self, bytes: &[u8], first: usize, count: usize) -> Vec<f64> {
        let every = (first, count);
        match self {
            RawFormat::Unorm8 => pieces(bytes, every, |[b]| f64::from(b) / 255.0),
            RawFormat::F16 => pieces(bytes, every, |b| f16::from_le_bytes(b).to_f64()),
            RawFormat::Unorm16 => pieces(bytes, every, |b| f64::from(u16::from_le_bytes(b)) / 65535.0),
            RawFormat::F32 => pieces(bytes, every, |b| f64::from(f32::from_le_bytes(b))),
            RawFormat::F64 => pieces(bytes, every, f64::from_le_bytes),
        }
    }
}

fn pieces<const N: usize>(
    bytes: &[u8],
    (first, count): (usize, usize),
    value: impl Fn([u8; N]) -> f64,
) -> Vec<f64> {
    bytes.as_chunks::<N>().0.iter().skip(first).step_by(count).map(|piece| value(*piece)).collect()
}

/// What the caller knows about a file that the file does not say.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hints {
    /// Texels along each axis, x fastest. Where the file is an image of two axes and this names
    /// three, the image is an atlas of slices: tiles of size x by y, left to right, then top to
    /// bottom.
    pub size: Option<Vec<usize>>,
    /// Values of a texel, for files that do not say.
    pub channels: Option<usize>,
    /// How numbers lie in raw files, and what integers in a text stand for.
    pub format: Option<RawFormat>,
    /// Name of the array in a text.
    pub symbol: Option<String>,
    /// Name of the layer of an EXR file.
    pub layer: Option<String>,
}
