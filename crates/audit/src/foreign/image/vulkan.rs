//! Texel formats of KTX 2 files. Source: Khronos, "Vulkan specification", enumeration VkFormat.

use super::packed::Pixels;
use crate::foreign::RawFormat::{F16, F32, F64, Unorm8, Unorm16};

/// The texels of a VkFormat, if they are read.
pub(super) fn pixels(format: u32) -> Option<Pixels> {
    let srgb = |order| Pixels { srgb: true, ..Pixels::of(Unorm8, order) };
    Some(match format {
        9 => Pixels::of(Unorm8, "R"),
        15 => srgb("R"),
        16 => Pixels::of(Unorm8, "RG"),
        22 => srgb("RG"),
        23 => Pixels::of(Unorm8, "RGB"),
        29 => srgb("RGB"),
        30 => Pixels::of(Unorm8, "BGR"),
        37 => Pixels::of(Unorm8, "RGBA"),
        43 => srgb("RGBA"),
        44 => Pixels::of(Unorm8, "BGRA"),
        50 => srgb("BGRA"),
        70 => Pixels::of(Unorm16, "R"),
        76 => Pixels::of(F16, "R"),
        77 => Pixels::of(Unorm16, "RG"),
        83 => Pixels::of(F16, "RG"),
        84 => Pixels::of(Unorm16, "RGB"),
        90 => Pixels::of(F16, "RGB"),
        91 => Pixels::of(Unorm16, "RGBA"),
        97 => Pixels::of(F16, "RGBA"),
        100 => Pixels::of(F32, "R"),
        103 => Pixels::of(F32, "RG"),
        106 => Pixels::of(F32, "RGB"),
        109 => Pixels::of(F32, "RGBA"),
        112 => Pixels::of(F64, "R"),
        115 => Pixels::of(F64, "RG"),
        118 => Pixels::of(F64, "RGB"),
        121 => Pixels::of(F64, "RGBA"),
        122 => Pixels::r11g11b10(),
        _ => return None,
    })
}

/// What a VkFormat that is not read is.
pub(super) fn name(format: u32) -> String {
    let what = match format {
        0 => "undefined: Basis Universal",
        131..=146 => "BC, block-compressed",
        147..=156 => "ETC2 or EAC, block-compressed",
        157..=184 | 1000066000..=1000066013 => "ASTC, block-compressed",
        123 => "E5B9G9R9, a shared exponent",
        1..=130 => "a format of other texels",
        _ => "no known format",
    };
    format!("VkFormat {format} ({what})")
}
