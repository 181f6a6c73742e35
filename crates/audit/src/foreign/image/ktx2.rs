//! KTX 2 textures of one to three dimensions and arrays of two, uncompressed or supercompressed
//! with Zstandard; the largest level. Layout: Khronos, "KTX File Format Specification", version
//! 2.0, section 3.

use std::io::Read;

use ruzstd::decoding::StreamingDecoder;

use super::packed::{CONVERT, Source};
use super::{Image, claimed, guarded, vulkan};
use crate::foreign::{ForeignError, ForeignTable, Hints, limits};

/// Byte of the first field after the identifier, and of the first level's index.
const FIELDS: u64 = 12;
const LEVELS: u64 = 80;

/// The table of a texture.
pub fn read(bytes: &[u8], file: &str, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    let source = Source { bytes, file };
    let [format, _, width, height, depth, layers, faces, _, scheme]: [u32; 9] =
        source.words(FIELDS, "the header")?;
    let pixels =
        vulkan::pixels(format).ok_or_else(|| source.unsupported(FIELDS, vulkan::name(format), CONVERT))?;
    if faces != 1 {
        return Err(source.unsupported(
            36,
            format!("a texture of {faces} faces"),
            "export it as a 2-D or 3-D texture",
        ));
    }
    if width == 0 {
        return Err(source.malformed(20, "the width is 0"));
    }
    let sides = [width, height.max(1), depth.max(1), layers.max(1)].map(u64::from);
    let [width, height, depth, layers] = sides;
    if depth > 1 && layers > 1 {
        return Err(source.unsupported(
            32,
            "an array of 3-D textures",
            "a table has one to three axes: export one of them",
        ));
    }
    let values = claimed(file, &sides, pixels.order.len() as u64)?;
    let length = (values / pixels.order.len() * pixels.bytes()) as u64;
    let level = level(source)?;
    let texels = match scheme {
        0 => level.to_vec(),
        2 => zstandard(source, level, length)?,
        1 => return Err(source.unsupported(44, "BasisLZ supercompression", CONVERT)),
        3 => {
            return Err(source.unsupported(
                44,
                "ZLIB supercompression",
                "write it uncompressed or with Zstandard",
            ));
        }
        n => {
            return Err(source.unsupported(
                44,
                format!("supercompression scheme {n}"),
                "write it uncompressed",
            ));
        }
    };
    if texels.len() as u64 != length {
        let message = format!(
            "the largest level has {} bytes, {width} x {height} x {} texels of {} have {length}: the file is cut short or damaged",
            texels.len(),
            depth * layers,
            pixels.words()
        );
        return Err(source.malformed(LEVELS, message));
    }
    let packing = if scheme == 2 { ", Zstandard" } else { "" };
    let kind = format!("KTX 2{packing}, {}", pixels.words());
    Image::packed(source, kind, &[width, height, depth * layers], (pixels, &texels), hints)
}

/// The bytes of the largest level.
fn level(source: Source<'_>) -> Result<&[u8], ForeignError> {
    let [offset, offset_high, length, length_high]: [u32; 4] = source.words(LEVELS, "the index of levels")?;
    let long = |low: u32, high: u32| u64::from(high) << 32 | u64::from(low);
    source.part(long(offset, offset_high), long(length, length_high), "the largest level")
}

/// At most one byte more than expected.
fn zstandard(source: Source, level: &[u8], expected: u64) -> Result<Vec<u8>, ForeignError> {
    if expected > limits::EXPANSION * level.len() as u64 {
        let message =
            format!("{} bytes cannot hold {expected}: the size in the header is wrong", level.len());
        return Err(source.malformed(LEVELS, message));
    }
    guarded(source.file, "Zstandard", || {
        let damaged =
            |reason: String| source.malformed(LEVELS, format!("the Zstandard stream is damaged: {reason}"));
        let mut decoder = StreamingDecoder::new(level).map_err(|e| damaged(e.to_string()))?;
        let mut texels = Vec::new();
        let read = decoder.by_ref().take(expected + 1).read_to_end(&mut texels);
        read.map_err(|e| damaged(e.to_string()))?;
        Ok(texels)
    })
}
