//! Which format a file is of.

use super::image::{dds, exr, hdr, ktx2, npy, png};
use super::shape::{self, Values};
use super::{ForeignError, ForeignTable, Hints, RawFormat, Spot, limits, text};

/// What is said of a file without bytes.
pub(super) const EMPTY: &str = "the file is empty";

/// First bytes of an EXR file.
const EXR_MAGIC: &[u8] = b"\x76\x2f\x31\x01";

/// What reads a file.
type Reader = fn(&[u8], &str, &Hints) -> Result<Vec<ForeignTable>, ForeignError>;

/// First bytes of known formats, with what reads them, or what they are of and what to do about it.
type Known = (&'static [u8], Result<Reader, (&'static str, &'static str)>);

const MAGIC: [Known; 13] = [
    (EXR_MAGIC, Ok(exr::read)),
    (b"DDS ", Ok(dds::read)),
    (b"\xabKTX 20\xbb\r\n\x1a\n", Ok(ktx2::read)),
    (b"\x89PNG\r\n\x1a\n", Ok(png::read)),
    (b"\x93NUMPY", Ok(npy::read)),
    (b"\xabKTX 11\xbb\r\n\x1a\n", Err(("KTX 1", "convert it to KTX 2 or DDS"))),
    (b"#?RADIANCE", Ok(hdr::read)),
    (b"#?RGBE", Ok(hdr::read)),
    (b"II*\0", Err(("TIFF", "convert it to EXR or PNG"))),
    (b"MM\0*", Err(("TIFF", "convert it to EXR or PNG"))),
    (b"\xff\xd8\xff", Err(("JPEG", "its compression loses values: find the original"))),
    (b"\x1f\x8b", Err(("a gzip archive", "unpack it first"))),
    (b"\x28\xb5\x2f\xfd", Err(("a zstd archive", "unpack it first"))),
];

/// Tables of a file: one, or one per array of a text and per layer of an EXR file. By its first
/// bytes, else by its extension (`raw`, `bin`, `dat`: raw numbers), else by being a text; `file` is
/// used for the extension and in messages. A layer that is a number, and no name of one, is a slice
/// across the third axis.
///
/// # Errors
/// Each names the file, the place and what to do: bytes beyond [`limits::BYTES`] or values beyond
/// [`limits::VALUES`]; what is not recognised, not supported, cut short or malformed; sizes that
/// contradict each other or cannot be told; values that are NaN or infinite.
pub fn read_table(bytes: &[u8], file: &str, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    let Some(layer) = &hints.layer else { return whole(bytes, file, hints) };
    let index = layer.parse::<usize>();
    if bytes.starts_with(EXR_MAGIC) {
        // A layer of an image may have a number for its name.
        let named = whole(bytes, file, hints);
        if named.is_ok() || index.is_err() {
            return named;
        }
    }
    let index = index.map_err(|_| {
        let message = format!("its layers have no names: give the number of a slice, from 0, not {layer}");
        ForeignError::new(file, message)
    })?;
    let layer = hints.layer.clone().filter(|_| !bytes.starts_with(EXR_MAGIC));
    shape::slices(file, whole(bytes, file, &Hints { layer, ..hints.clone() })?, index)
}

/// The tables with all of their slices.
fn whole(bytes: &[u8], file: &str, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    if bytes.is_empty() {
        return Err(ForeignError::new(file, EMPTY));
    }
    if bytes.len() as u64 > limits::BYTES {
        return Err(ForeignError::too_large(file, "bytes", bytes.len(), limits::BYTES));
    }
    reader(bytes, file, hints)?(bytes, file, hints)
}

fn reader(bytes: &[u8], file: &str, hints: &Hints) -> Result<Reader, ForeignError> {
    if let Some((_, known)) = MAGIC.iter().find(|(magic, _)| bytes.starts_with(magic)) {
        return known.map_err(|(what, advice)| ForeignError::unsupported(file, Spot::Byte(0), what, advice));
    }
    let extension = extension(file);
    let unknown = |message: String| Err(ForeignError::new(file, message));
    match extension.as_str() {
        "raw" | "bin" | "dat" | "f16" | "f32" | "f64" => return Ok(raw),
        "exr" | "dds" | "hdr" | "ktx2" | "png" | "npy" => {
            return unknown(format!(
                "its name ends in .{extension}, its first bytes are not those of such a file: it is damaged or misnamed"
            ));
        }
        _ => {}
    }
    let texts = std::str::from_utf8(bytes).is_ok_and(|text| !text.contains('\0'));
    match (texts, hints.format) {
        (true, _) => Ok(text::read),
        (false, Some(_)) => Ok(raw),
        (false, None) => unknown(
            "it is no EXR, DDS, KTX 2, PNG, NPY, Radiance file or UTF-8 text: for numbers without a header state their format, one of \
             f16, f32, f64, unorm8, unorm16"
                .into(),
        ),
    }
}

/// The extension of a file's name, in small letters; nothing where it has none.
fn extension(file: &str) -> String {
    file.rsplit_once('.').map_or(String::new(), |(_, extension)| extension.to_ascii_lowercase())
}

/// Largest bits of a half up to 2, and numbers that tell singles from pairs of them.
const TWO: u16 = 0x4000;
const TELLING: usize = 16;

/// Whether singles may be pairs of halves of 0 to 2 as well: low bits of singles are any.
fn may_be_halves(bytes: &[u8]) -> bool {
    let halves = || bytes.chunks_exact(2).map(|two| u16::from_le_bytes([two[0], two[1]]));
    let low = || halves().step_by(2);
    low().len() >= TELLING && halves().all(|half| half <= TWO) && low().any(|half| half > 0)
}

/// The table of little-endian numbers without a header: of the format that the caller states, else of that
/// in the file's name, else singles.
fn raw(bytes: &[u8], file: &str, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    let named = || match extension(file).as_str() {
        "f16" => Some(RawFormat::F16),
        "f32" => Some(RawFormat::F32),
        "f64" => Some(RawFormat::F64),
        _ => None,
    };
    let stated = hints.format.or_else(named);
    if stated.is_none() && may_be_halves(bytes) {
        let message = "its bytes are halves of 0 to 2 as well as singles: state their format, f16 or f32";
        return Err(ForeignError::new(file, message));
    }
    let format = stated.unwrap_or(RawFormat::F32);
    let left = bytes.len() % format.bytes();
    if left != 0 {
        let at = Spot::Byte((bytes.len() - left) as u64);
        let (name, width) = (format.name(), format.bytes());
        let message = format!(
            "the last {left} bytes are no {name} of {width}: the file is cut short, or state another format"
        );
        return Err(ForeignError::at(file, at, message));
    }
    let list = Values::numbers(format!("raw {}", format.name()), format, bytes);
    Ok(vec![shape::table(file, list, hints)?])
}
