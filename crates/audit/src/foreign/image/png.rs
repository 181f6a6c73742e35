//! PNG images of 8 and 16 bits. Values are those stored, divided by 255 or 65535: a colour space
//! that the file names is named too, and not applied, for what tables hold are no colours.

use std::io::Cursor;

use ::png::{BitDepth, ColorType, Decoder, DecodingError, Info, Limits, Transformations};

use super::packed::{Pixels, Source};
use super::{Image, claimed, guarded};
use crate::foreign::{ForeignError, ForeignTable, Hints, RawFormat, limits};

/// The table of an image.
pub fn read(bytes: &[u8], file: &str, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    guarded(file, "PNG", || decode(Source { bytes, file }, hints))
}

fn decode(source: Source, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    let damaged = |e: DecodingError| {
        let other = || source.malformed(0, format!("{e}: the file is damaged"));
        chunks(source).err().unwrap_or_else(other)
    };
    let most = Limits { bytes: limits::BYTES as usize };
    let mut decoder = Decoder::new_with_limits(Cursor::new(source.bytes), most);
    decoder.set_transformations(Transformations::IDENTITY);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let info = decoder.read_header_info().map_err(damaged)?;
    let (width, height) = (info.width, info.height);
    let pixels = pixels(source, info.color_type, info.bit_depth)?;
    let values = claimed(source.file, &[width.into(), height.into()], pixels.order.len() as u64)?;
    let length = values / pixels.order.len() * pixels.bytes();
    if length as u64 > limits::EXPANSION * source.bytes.len() as u64 {
        return Err(source
            .malformed(16, format!("the file cannot hold {width} x {height} texels: the header is wrong")));
    }
    let mut reader = decoder.read_info().map_err(damaged)?;
    let marks = marks(reader.info());
    let mut texels = vec![0; length];
    reader.next_frame(&mut texels).map_err(damaged)?;
    if pixels.step() == RawFormat::Unorm16.step() {
        texels.as_chunks_mut::<2>().0.iter_mut().for_each(|pair| pair.reverse());
    }
    let kind = format!("PNG, {}{marks}", pixels.words());
    Image::packed(source, kind, &[width.into(), height.into()], (pixels, &texels), hints)
}

/// Looks through the chunks, for an end before that of the last.
fn chunks(source: Source) -> Result<(), ForeignError> {
    let mut at = 8;
    loop {
        let head = source.part(at, 8, "the head of a chunk")?;
        let (length, name) = head.split_at(4);
        let length = length.iter().fold(0, |length, byte| length << 8 | u64::from(*byte));
        let what = format!("chunk {} with its check sum", name.escape_ascii());
        source.part(at + 8, length + 4, &what)?;
        if name == b"IEND" {
            return Ok(());
        }
        at += length + 12;
    }
}

fn pixels(source: Source, colour: ColorType, depth: BitDepth) -> Result<Pixels, ForeignError> {
    let format = match depth {
        BitDepth::Eight => RawFormat::Unorm8,
        BitDepth::Sixteen => RawFormat::Unorm16,
        _ => {
            let what = format!("a PNG of {} bits", depth as u8);
            return Err(source.unsupported(24, what, "save it with 8 or 16 bits per channel"));
        }
    };
    Ok(Pixels::of(
        format,
        match colour {
            ColorType::Grayscale => "R",
            ColorType::GrayscaleAlpha => "RA",
            ColorType::Rgb => "RGB",
            ColorType::Rgba => "RGBA",
            ColorType::Indexed => {
                return Err(source.unsupported(25, "a PNG with a palette", "save it as grey, RGB or RGBA"));
            }
        },
    ))
}

/// What the file says about how its values are to be shown, and that it may be an animation.
fn marks(info: &Info) -> String {
    let mut marks = String::new();
    if info.srgb.is_some() {
        marks += " marked sRGB (values as stored)";
    } else if let Some(gamma) = info.gama_chunk {
        marks += &format!(" marked gamma {} (values as stored)", gamma.into_value());
    }
    if info.animation_control.is_some() {
        marks += ", first frame";
    }
    marks
}
