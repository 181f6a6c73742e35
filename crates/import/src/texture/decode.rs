//! Images to counts of their values. Dimensions are looked at before a texel is decoded.

use std::io::Cursor;

use image_webp::WebPDecoder;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::histogram::Histogram;
use crate::limits;

/// What became of the bytes of an image.
pub(super) enum Decoded {
    Texels(Histogram),
    /// It is of a kind, or of a size, that is not decoded: the rest of "an image ...".
    Not(String),
}

/// Decodes an image of at most `left` texels.
///
/// # Errors
/// A broken image, in words.
pub(super) fn decode(bytes: &[u8], left: u64) -> Result<Decoded, String> {
    let broken = |kind: &str, e: &dyn std::fmt::Display| format!("a broken {kind}: {}", e.to_string().trim());
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => png(bytes, left).map_err(|e| broken("PNG", &e)),
        [0xff, 0xd8, 0xff, ..] => jpeg(bytes, left).map_err(|e| broken("JPEG", &e)),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => {
            webp(bytes, left).map_err(|e| broken("WebP", &e))
        }
        [0xab, b'K', b'T', b'X', ..] | [b's', b'B', ..] => {
            Ok(Decoded::Not("of KTX2 or Basis, which this version does not decode".into()))
        }
        _ => Ok(Decoded::Not("of a format that this version does not decode: PNG, JPEG and WebP are".into())),
    }
}

/// Why an image is too large, if it is; `bytes` are what its decoder takes for a texel.
fn too_large(size: [u64; 2], bytes: u64, left: u64) -> Option<String> {
    let texels = size[0].saturating_mul(size[1]);
    if texels > limits::TEXELS {
        Some(format!("of {} x {} texels, more than {}", size[0], size[1], limits::TEXELS))
    } else if texels.saturating_mul(bytes) > limits::DECODED_BYTES {
        Some(format!(
            "of {} x {} texels that takes more than {} bytes to decode",
            size[0],
            size[1],
            limits::DECODED_BYTES
        ))
    } else if texels > left {
        let (all, of_byte) = (limits::ALL_TEXELS, limits::TEXELS_OF_BYTE);
        Some(format!(
            "beyond the {all} texels of all images of a scene, and {of_byte} for each of their bytes"
        ))
    } else {
        None
    }
}

/// Row by row: of interlaced images the rows of their passes.
fn png(bytes: &[u8], left: u64) -> Result<Decoded, png::DecodingError> {
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: 1 << 24 });
    decoder.set_transformations(png::Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let mut reader = decoder.read_info()?;
    let size = [reader.info().width.into(), reader.info().height.into()];
    if let Some(why) = too_large(size, 0, left) {
        return Ok(Decoded::Not(why));
    }
    let (colour, depth) = reader.output_color_type();
    let mut counts = Histogram::new(depth == png::BitDepth::Sixteen);
    while let Some(row) = reader.next_row()? {
        counts.count_texels(row.data(), colour.samples());
    }
    Ok(Decoded::Texels(counts))
}

fn jpeg(bytes: &[u8], left: u64) -> Result<Decoded, String> {
    let side = usize::from(u16::MAX);
    let options = DecoderOptions::default().set_strict_mode(true).set_max_width(side).set_max_height(side);
    let options = options.jpeg_set_max_scans(limits::JPEG_SCANS);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|e| e.to_string())?;
    let info = decoder.info().ok_or("no header")?;
    let samples = match decoder.input_colorspace() {
        Some(ColorSpace::Luma) => 1,
        Some(ColorSpace::YCbCr | ColorSpace::RGB) => 3,
        _ => return Ok(Decoded::Not("of colours that this version does not decode: those of print".into())),
    };
    // The coefficients of a progressive image, of 16 bits, are there at once.
    let bytes_each = if is_progressive(bytes) { 3 } else { 1 };
    if let Some(why) = too_large([info.width.into(), info.height.into()], bytes_each * samples as u64, left) {
        return Ok(Decoded::Not(why));
    }
    let colour = if samples == 1 { ColorSpace::Luma } else { ColorSpace::RGB };
    decoder.set_options(options.jpeg_set_out_colorspace(colour));
    let texels = decoder.decode().map_err(|e| e.to_string())?;
    let mut counts = Histogram::new(false);
    counts.count_texels(&texels, samples);
    Ok(Decoded::Texels(counts))
}

/// Whether the frame of a JPEG is progressive: the kind of its first start-of-frame segment. What is not
/// plainly sequential counts as the costlier of the two.
fn is_progressive(bytes: &[u8]) -> bool {
    let mut at = 2;
    while bytes.get(at) == Some(&0xff) {
        // Any number of fill bytes stands before the kind of a segment.
        while bytes.get(at) == Some(&0xff) {
            at += 1;
        }
        let Some(&[kind, high, low]) = bytes.get(at..at + 3) else { return true };
        match kind {
            0xc0 | 0xc1 => return false,
            // Tables, restart intervals, data of applications, comments.
            0xc4 | 0xdb | 0xdd | 0xe0..=0xef | 0xfe => {}
            _ => return true,
        }
        at += 1 + (usize::from(high) << 8 | usize::from(low));
    }
    true
}

fn webp(bytes: &[u8], left: u64) -> Result<Decoded, String> {
    let mut decoder = WebPDecoder::new(Cursor::new(bytes)).map_err(|e| e.to_string())?;
    decoder.set_memory_limit(limits::DECODED_BYTES as usize);
    let (width, height) = decoder.dimensions();
    let samples = if decoder.has_alpha() { 4 } else { 3 };
    // Its result, and planes of about as many bytes on the way there.
    if let Some(why) = too_large([width.into(), height.into()], 8, left) {
        return Ok(Decoded::Not(why));
    }
    if decoder.is_animated() {
        return Ok(Decoded::Not("that is animated".into()));
    }
    let mut texels = vec![0; decoder.output_buffer_size().ok_or("its size overflows")?];
    decoder.read_image(&mut texels).map_err(|e| e.to_string())?;
    let mut counts = Histogram::new(false);
    counts.count_texels(&texels, samples);
    Ok(Decoded::Texels(counts))
}
