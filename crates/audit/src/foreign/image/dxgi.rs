//! Texel formats of DirectDraw surfaces. Source: Microsoft, "DXGI_FORMAT" and "Programming guide
//! for DDS".

use super::packed::Pixels;
use crate::foreign::RawFormat::{F16, F32, Unorm8, Unorm16};

/// The texels of a DXGI_FORMAT, if they are read.
pub(super) fn pixels(format: u32) -> Option<Pixels> {
    let srgb = |order| Pixels { srgb: true, ..Pixels::of(Unorm8, order) };
    Some(match format {
        2 => Pixels::of(F32, "RGBA"),
        6 => Pixels::of(F32, "RGB"),
        10 => Pixels::of(F16, "RGBA"),
        11 => Pixels::of(Unorm16, "RGBA"),
        16 => Pixels::of(F32, "RG"),
        26 => Pixels::r11g11b10(),
        28 => Pixels::of(Unorm8, "RGBA"),
        29 => srgb("RGBA"),
        34 => Pixels::of(F16, "RG"),
        35 => Pixels::of(Unorm16, "RG"),
        41 => Pixels::of(F32, "R"),
        49 => Pixels::of(Unorm8, "RG"),
        54 => Pixels::of(F16, "R"),
        56 => Pixels::of(Unorm16, "R"),
        61 => Pixels::of(Unorm8, "R"),
        65 => Pixels::of(Unorm8, "A"),
        87 => Pixels::of(Unorm8, "BGRA"),
        91 => srgb("BGRA"),
        _ => return None,
    })
}

/// What a DXGI_FORMAT that is not read is.
pub(super) fn name(format: u32) -> String {
    let what = match format {
        70..=84 | 94..=99 => "a block-compressed format",
        24 => "R10G10B10A2",
        67 => "R9G9B9E5, a shared exponent",
        88 | 93 => "B8G8R8X8",
        0 => "unknown, 0",
        1..=132 => "a format of other texels",
        _ => "no known format",
    };
    format!("DXGI_FORMAT {format} ({what})")
}

/// The texels of the code of a surface without the extended header.
pub(super) fn of_code(code: [u8; 4]) -> Option<Pixels> {
    Some(match u32::from_le_bytes(code) {
        36 => Pixels::of(Unorm16, "RGBA"),
        111 => Pixels::of(F16, "R"),
        112 => Pixels::of(F16, "RG"),
        113 => Pixels::of(F16, "RGBA"),
        114 => Pixels::of(F32, "R"),
        115 => Pixels::of(F32, "RG"),
        116 => Pixels::of(F32, "RGBA"),
        _ => return None,
    })
}

/// The texels of bit masks: bits of a texel, then the masks of red, green, blue, alpha.
pub(super) fn of_masks(bits: u32, masks: [u32; 4]) -> Option<Pixels> {
    Some(match (bits, masks) {
        (32, [0xff, 0xff00, 0xff_0000, 0xff00_0000]) => Pixels::of(Unorm8, "RGBA"),
        (32, [0xff_0000, 0xff00, 0xff, 0xff00_0000]) => Pixels::of(Unorm8, "BGRA"),
        (24, [0xff, 0xff00, 0xff_0000, 0]) => Pixels::of(Unorm8, "RGB"),
        (24, [0xff_0000, 0xff00, 0xff, 0]) => Pixels::of(Unorm8, "BGR"),
        (32, [0xffff, 0xffff_0000, 0, 0]) => Pixels::of(Unorm16, "RG"),
        (16, [0xffff, 0, 0, 0]) => Pixels::of(Unorm16, "R"),
        (8, [0xff, 0, 0, 0]) => Pixels::of(Unorm8, "R"),
        _ => return None,
    })
}
