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
    base64(figure, smallest(size, levels, Some(&shade.palette())))
}

/// Bytes of red, green and blue, pixel by pixel and row by row from the top, as a PNG in base64.
pub(crate) fn rgb(figure: &str, size: (usize, usize), bytes: &[u8]) -> Result<String, ReportError> {
    base64(figure, smallest(size, bytes, None))
}

fn base64(figure: &str, encoded: Result<Vec<u8>, png::EncodingError>) -> Result<String, ReportError> {
    let refused =
        |e: png::EncodingError| ReportError::Drawing { section: figure.into(), reason: e.to_string() };
    Ok(STANDARD.encode(encoded.map_err(refused)?))
}

/// Filters that are tried. Which is the best depends on the picture: of rendered rooms none at all, of
/// smooth values one of the differences.
const FILTERS: [png::Filter; 5] =
    [png::Filter::NoFilter, png::Filter::Sub, png::Filter::Up, png::Filter::Paeth, png::Filter::Adaptive];

/// The smallest PNG of 8 bits a channel: indices of a palette, or colours without one.
fn smallest(
    size: (usize, usize),
    pixels: &[u8],
    palette: Option<&[u8]>,
) -> Result<Vec<u8>, png::EncodingError> {
    let encoded = FILTERS.into_iter().map(|filter| encode(size, pixels, palette, filter));
    let encoded = encoded.collect::<Result<Vec<Vec<u8>>, _>>()?;
    Ok(encoded.into_iter().min_by_key(Vec::len).unwrap_or_default())
}

fn encode(
    (width, height): (usize, usize),
    pixels: &[u8],
    palette: Option<&[u8]>,
    filter: png::Filter,
) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_depth(png::BitDepth::Eight);
    match palette {
        Some(palette) => {
            encoder.set_color(png::ColorType::Indexed);
            encoder.set_palette(palette);
        }
        None => encoder.set_color(png::ColorType::Rgb),
    }
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(filter);
    let mut writer = encoder.write_header()?;
    let mut stream = writer.stream_writer()?;
    stream.write_all(pixels)?;
    stream.finish()?;
    writer.finish()?;
    Ok(bytes)
}
