//! Pictures of values: one palette index per pixel, as a PNG.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::colour::Shade;
use crate::report::ReportError;

/// Palette indices, row by row from the top, as a PNG in base64 with the colours of `shade`.
pub(crate) fn png(
    figure: &str,
    size: (usize, usize),
    levels: &[u8],
    shade: Shade,
) -> Result<String, ReportError> {
    let bytes = encode(size, levels, shade.palette())
        .map_err(|e| ReportError::Drawing { section: figure.into(), reason: e.to_string() })?;
    Ok(STANDARD.encode(bytes))
}

fn encode(
    (width, height): (usize, usize),
    levels: &[u8],
    palette: Vec<u8>,
) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette);
    encoder.set_compression(png::Compression::High);
    // Palettes are ordered, so a smooth picture has small differences of indices: a fifth smaller than unfiltered.
    encoder.set_filter(png::Filter::Sub);
    let mut writer = encoder.write_header()?;
    let mut stream = writer.stream_writer()?;
    stream.write_all(levels)?;
    stream.finish()?;
    writer.finish()?;
    Ok(bytes)
}
