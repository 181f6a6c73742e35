//! DirectDraw surfaces, with and without the extended header: textures of one, two and three
//! dimensions and arrays of two, uncompressed; the largest level. Layout: Microsoft, "DDS_HEADER",
//! "DDS_PIXELFORMAT", "DDS_HEADER_DXT10".

use super::packed::{CONVERT, Pixels, Source};
use super::{Image, claimed, dxgi};
use crate::foreign::{ForeignError, ForeignTable, Hints};

/// DDPF_FOURCC.
const FOURCC: u32 = 0x4;
/// DDPF_ALPHA | DDPF_RGB | DDPF_LUMINANCE: bit masks hold.
const MASKS: u32 = 0x2 | 0x40 | 0x2_0000;
/// DDSCAPS2_CUBEMAP and DDSCAPS2_VOLUME.
const CUBE: u32 = 0x200;
const VOLUME: u32 = 0x20_0000;
/// Byte of the pixel format's code, and of the extended header.
const CODE: u64 = 84;
const EXTENSION: u64 = 128;

/// What the headers say.
struct Header {
    pixels: Pixels,
    width: u64,
    height: u64,
    depth: u64,
    levels: u32,
    /// Textures of an array.
    textures: u64,
    /// Byte of the first texel.
    start: u64,
}

/// The table of a surface.
pub fn read(bytes: &[u8], file: &str, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    let source = Source { bytes, file };
    let header = header(source)?;
    let Header { pixels, width, height, depth, textures, start, .. } = header;
    let texel = pixels.bytes() as u64;
    claimed(file, &[width, height, depth, textures], pixels.order.len() as u64)?;
    // Every side is below 2^24 now.
    let stride = chain(&header, texel);
    let end = start + stride * textures;
    let left = (bytes.len() as u64).saturating_sub(end);
    let mut texels = Vec::new();
    for texture in 0..textures {
        let length = width * height * depth * texel;
        let what = format!("{width} x {height} x {depth} texels of {}", pixels.words());
        texels.extend_from_slice(source.part(start + texture * stride, length, &what)?);
    }
    if left > 0 {
        let message = format!(
            "{left} bytes follow the texels that the header announces: its size or its format is wrong"
        );
        return Err(source.malformed(end, message));
    }
    let third = if textures > 1 { textures } else { depth };
    let kind = format!("DDS, {}", pixels.words());
    Image::packed(source, kind, &[width, height, third], (pixels, &texels), hints)
}

/// Bytes of a texture with its smaller levels.
fn chain(header: &Header, texel: u64) -> u64 {
    let side = |n: u64, level: u32| n.checked_shr(level).unwrap_or(0).max(1);
    let level = |l: u32| side(header.width, l) * side(header.height, l) * side(header.depth, l) * texel;
    // Sides are below 2^24: beyond 24 levels, no texel is left.
    (0..header.levels.min(25)).map(level).sum()
}

fn header(source: Source) -> Result<Header, ForeignError> {
    let words: [u32; 31] = source.words(4, "the header")?;
    let [size, _, height, width, _, depth, levels, ..] = words;
    if size != 124 {
        return Err(
            source.malformed(4, format!("the header's size is {size}, not 124: no DDS file, or damaged"))
        );
    }
    let [flags, code, bits, red, green, blue, alpha] =
        [words[19], words[20], words[21], words[22], words[23], words[24], words[25]];
    let caps2 = words[27];
    if caps2 & CUBE != 0 {
        return Err(source.unsupported(
            112,
            "a cube map",
            "a table has one to three axes: export it as a 2-D or 3-D texture",
        ));
    }
    let code = code.to_le_bytes();
    let extended = flags & FOURCC != 0 && code == *b"DX10";
    let (pixels, textures, solid) = if extended {
        extension(source)?
    } else {
        let pixels = if flags & FOURCC != 0 {
            dxgi::of_code(code)
        } else if flags & MASKS != 0 {
            dxgi::of_masks(bits, [red, green, blue, alpha])
        } else {
            None
        };
        let what = || match flags & FOURCC {
            0 => format!("a texel of {bits} bits with the masks {red:#x} {green:#x} {blue:#x} {alpha:#x}"),
            _ => format!("the format {}", code.escape_ascii()),
        };
        (pixels.ok_or_else(|| source.unsupported(CODE, what(), CONVERT))?, 1, caps2 & VOLUME != 0)
    };
    let header = Header {
        pixels,
        width: width.into(),
        height: u64::from(height).max(1),
        depth: if solid { u64::from(depth).max(1) } else { 1 },
        levels: levels.max(1),
        textures,
        start: EXTENSION + if extended { 20 } else { 0 },
    };
    if header.width == 0 {
        return Err(source.malformed(16, "the width is 0"));
    }
    Ok(header)
}

/// Texels, textures, and whether they are of three dimensions, from the extended header.
fn extension(source: Source) -> Result<(Pixels, u64, bool), ForeignError> {
    let [format, dimension, flags, textures, _]: [u32; 5] = source.words(EXTENSION, "the extended header")?;
    let pixels =
        dxgi::pixels(format).ok_or_else(|| source.unsupported(EXTENSION, dxgi::name(format), CONVERT))?;
    if flags & 0x4 != 0 {
        return Err(source.unsupported(EXTENSION + 8, "a cube map", "export it as a 2-D or 3-D texture"));
    }
    if !(2..=4).contains(&dimension) {
        return Err(source.malformed(EXTENSION + 4, format!("the dimension is {dimension}, not 2, 3 or 4")));
    }
    Ok((pixels, u64::from(textures).max(1), dimension == 4))
}
