//! Pictures of values: one palette index per pixel, as a PNG.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::canvas::{Align, Frame, INK, TEXT, picture, sheet};
use super::colour::Shade;
use super::{Figure, font};
use crate::ReportError;

/// A picture of any shape in colours of a palette, as large on the page as it has pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    /// Line above it.
    pub title: String,
    /// Width and height.
    pub size: (usize, usize),
    /// Indices of the palette, row by row from the top.
    pub levels: Vec<u8>,
    /// Red, green and blue of each colour.
    pub palette: Vec<u8>,
}

impl Figure for Pixels {
    fn svg(&self) -> Result<String, ReportError> {
        let (left, top) = (4.0, 26.0);
        let frame = Frame { left, top, right: left + self.size.0 as f64, bottom: top + self.size.1 as f64 };
        let png = base64(&self.title, smallest(self.size, &self.levels, Some(&self.palette)))?;
        let under = picture(&png, frame, true);
        sheet(&self.title, (frame.right + 4.0, frame.bottom + 4.0), &under, |canvas| {
            let title = font::shorten(&self.title, TEXT, frame.width())?;
            canvas.text(&title, (left, 12.0), TEXT, Align::Left, INK)
        })
    }
}

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

/// Filters that are tried. Which is the best depends on the picture: of rendered rooms none at all,
/// of smooth values one of the differences.
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
