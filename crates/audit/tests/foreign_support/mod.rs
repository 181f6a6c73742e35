//! Small valid files of other tools' formats, built from the formats' specifications.
#![allow(dead_code, reason = "each test uses some of them")]

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer,
    LayerAttributes, SmallVec, WritableImage,
};
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

/// What texel t holds in channel c: no two alike, all in [0, 1), exact in f32.
pub fn value(t: usize, c: usize) -> f64 {
    (t * 4 + c) as f64 / 512.0
}

fn words(list: &[u32]) -> Vec<u8> {
    list.iter().flat_map(|w| w.to_le_bytes()).collect()
}

/// The magic number and the header of a DDS file.
fn dds_header(code: [u8; 4], [width, height, depth]: [u32; 3]) -> Vec<u8> {
    let mut list = vec![124, 0x1007, height, width, 0, depth, 1];
    list.extend([0; 11]);
    list.extend([
        32,
        4,
        u32::from_le_bytes(code),
        0,
        0,
        0,
        0,
        0,
        0x1000,
        if depth > 1 { 0x20_0000 } else { 0 },
        0,
        0,
        0,
    ]);
    [b"DDS ".to_vec(), words(&list)].concat()
}

/// A DDS file of a format's code.
pub fn dds(code: [u8; 4], size: [u32; 3], texels: &[u8]) -> Vec<u8> {
    [dds_header(code, size), texels.to_vec()].concat()
}

/// A DDS file with the extended header.
pub fn dds_extended(format: u32, size: [u32; 3], textures: u32, texels: &[u8]) -> Vec<u8> {
    let extension = words(&[format, if size[2] > 1 { 4 } else { 3 }, 0, textures, 0]);
    [dds_header(*b"DX10", size), extension, texels.to_vec()].concat()
}

/// A KTX 2 file of one level.
pub fn ktx2(
    format: u32,
    [width, height, depth]: [u32; 3],
    layers: u32,
    texels: &[u8],
    packed: bool,
) -> Vec<u8> {
    let data = if packed { compress_to_vec(texels, CompressionLevel::Fastest) } else { texels.to_vec() };
    let mut bytes = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    bytes.extend(words(&[format, 2, width, height, depth, layers, 1, 1, if packed { 2 } else { 0 }]));
    bytes.extend(words(&[0; 8]));
    let start = bytes.len() as u64 + 24;
    bytes.extend([start, data.len() as u64, texels.len() as u64].iter().flat_map(|n| n.to_le_bytes()));
    bytes.extend(data);
    bytes
}

/// A PNG file; 16-bit values are big-endian already.
pub fn png(width: u32, height: u32, channels: usize, sixteen: bool, data: &[u8], srgb: bool) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(match channels {
        1 => png::ColorType::Grayscale,
        2 => png::ColorType::GrayscaleAlpha,
        3 => png::ColorType::Rgb,
        _ => png::ColorType::Rgba,
    });
    encoder.set_depth(if sixteen { png::BitDepth::Sixteen } else { png::BitDepth::Eight });
    if srgb {
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    }
    encoder.write_header().unwrap().write_image_data(data).unwrap();
    bytes
}

/// A Radiance file of one exponent, 128, with the components of every line in runs, or texel by texel.
pub fn hdr(size: [usize; 2], texels: &[[u8; 3]], runs: bool) -> Vec<u8> {
    let [width, height] = size;
    let head = "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n";
    let mut bytes = format!("{head}-Y {height} +X {width}\n").into_bytes();
    for line in texels.chunks(width) {
        if !runs {
            bytes.extend(line.iter().flat_map(|[r, g, b]| [*r, *g, *b, 128]));
            continue;
        }
        bytes.extend([2, 2, (width >> 8) as u8, width as u8]);
        for c in 0..3 {
            // Some as they are, the last two as runs of one.
            bytes.push((width - 2) as u8);
            bytes.extend(line[..width - 2].iter().map(|t| t[c]));
            line[width - 2..].iter().for_each(|t| bytes.extend([129, t[c]]));
        }
        bytes.extend([128 + width as u8, 128]);
    }
    bytes
}

/// An EXR file of parts of 6 x 4 texels with the named channels.
pub fn exr_of_parts(parts: &[(&str, &[&str])]) -> Vec<u8> {
    exr((6, 4), parts, value)
}

/// An EXR file of parts of a size, with the named channels and what each holds at a texel.
pub fn exr(size: (usize, usize), parts: &[(&str, &[&str])], value: fn(usize, usize) -> f64) -> Vec<u8> {
    let texels = 0..size.0 * size.1;
    let layers: Vec<Layer<AnyChannels<FlatSamples>>> = parts
        .iter()
        .map(|(name, channels)| {
            let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = channels
                .iter()
                .enumerate()
                .map(|(c, name)| {
                    AnyChannel::new(
                        *name,
                        FlatSamples::F32(texels.clone().map(|t| value(t, c) as f32).collect()),
                    )
                })
                .collect();
            Layer::new(
                size,
                LayerAttributes::named(*name),
                Encoding::SMALL_LOSSLESS,
                AnyChannels::sort(channels),
            )
        })
        .collect();
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(size));
    let mut bytes = Cursor::new(Vec::new());
    let image = Image::from_layers(attributes, layers);
    image.write().non_parallel().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}
