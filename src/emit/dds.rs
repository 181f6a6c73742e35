//! DirectDraw surfaces with the extended header of Direct3D 10: a 3-D texture, or a 2-D texture for
//! two axes, one level, texels tightly packed.
//!
//! Layout and values: Microsoft, "Programming guide for DDS", "DDS_HEADER", "DDS_HEADER_DXT10".

use super::texels::Packed;
use super::texture::{Field, Texel, Texture, TextureError};
use crate::data::{Container, Table};

/// Magic number.
const MAGIC: &[u8; 4] = b"DDS ";

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

/// DXGI_FORMAT by name and number.
pub fn format(texel: Texel) -> (&'static str, u32) {
    texel.named([
        [("R8_UNORM", 61), ("R8G8_UNORM", 49), ("R8G8B8A8_UNORM", 28)],
        [("R16_UNORM", 56), ("R16G16_UNORM", 35), ("R16G16B16A16_UNORM", 11)],
        [("R16_FLOAT", 54), ("R16G16_FLOAT", 34), ("R16G16B16A16_FLOAT", 10)],
        [("R32_FLOAT", 41), ("R32G32_FLOAT", 16), ("R32G32B32A32_FLOAT", 2)],
    ])
}

/// Header and extension, after the magic number.
fn header(texture: &Texture) -> Vec<Field> {
    let Texture { size: [width, height, depth], solid, texel, pitch } = *texture;
    let (flags, caps2) = if solid { (FLAGS | FLAG_DEPTH, CAPS_VOLUME) } else { (FLAGS, 0) };
    let mut fields = vec![
        ("dwSize", 124),
        ("dwFlags", flags),
        ("dwHeight", height),
        ("dwWidth", width),
        ("dwPitchOrLinearSize", pitch),
        ("dwDepth", if solid { depth } else { 0 }),
        ("dwMipMapCount", 1),
    ];
    fields.extend([("dwReserved1", 0); 11]);
    fields.extend([("ddspf.dwSize", 32), ("ddspf.dwFlags", PIXEL_FOURCC)]);
    fields.push(("ddspf.dwFourCC", u32::from_le_bytes(FOURCC)));
    fields.extend(["RGBBitCount", "RBitMask", "GBitMask", "BBitMask", "ABitMask"].map(|name| (name, 0)));
    fields.extend([("dwCaps", CAPS), ("dwCaps2", caps2)]);
    fields.extend(["dwCaps3", "dwCaps4", "dwReserved2"].map(|name| (name, 0)));
    fields.extend([("dxgiFormat", format(texel).1), ("resourceDimension", DIMENSIONS[usize::from(solid)])]);
    // No cube, one texture, meaning of alpha not stated.
    fields.extend([("miscFlag", 0), ("arraySize", 1), ("miscFlags2", 0)]);
    fields
}

/// How a file holds a validated table.
///
/// # Errors
/// More channels than four, an axis longer than 2^32 - 1 or a row of as many bytes.
pub fn packed(table: &Table) -> Result<Packed, TextureError> {
    let texture = Texture::new(table, Container::Dds)?;
    Ok(texture.packed(MAGIC, header(&texture), &[]))
}
