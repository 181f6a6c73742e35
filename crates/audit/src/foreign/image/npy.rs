//! NumPy arrays (numpy.lib.format, versions 1 to 3): little-endian numbers.

use super::packed::Source;
use crate::foreign::shape::{self, Values, grouped};
use crate::foreign::{ForeignError, ForeignTable, Hints, RawFormat, Spot};

/// Bytes before the length of the dictionary.
const PREFIX: u64 = 8;

/// The table of an array: its last index is x, or the channel where it is short; a first index of two
/// or three is the channel too, unless one of these is asked for as a slice.
pub fn read(bytes: &[u8], file: &str, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    let source = Source { bytes, file };
    let (start, text) = dictionary(source)?;
    let field = |name: &str| {
        let missing =
            || source.malformed(PREFIX, format!("the dictionary has no {name}: no NPY file, or damaged"));
        text.split_once(&format!("'{name}':")).map(|(_, rest)| rest.trim_start()).ok_or_else(missing)
    };
    let kind = field("descr")?.split('\'').nth(1).unwrap_or_default();
    let format = number(source, kind, hints)?;
    let is_of_columns = !field("fortran_order")?.starts_with("False");
    let shape = extents(source, field("shape")?)?;
    let found = (bytes.len() - start) as u128;
    let needed = shape.iter().try_fold(format.bytes() as u128, |n, &side| n.checked_mul(side as u128));
    if needed != Some(found) {
        let message = format!(
            "{found} bytes follow, and an array of {} {kind} has {}",
            shape::words(&shape),
            needed.map_or_else(|| "more than can be counted".into(), |n| n.to_string())
        );
        return Err(source.malformed(start as u64, message));
    }
    let (size, channels) = match &shape[..] {
        [length] => (Some((vec![*length], 1)), None),
        shape => grouped(shape, false).map_err(|message| source.malformed(PREFIX, message))?,
    };
    contradicted(source, &shape, size.as_ref(), hints)?;
    let list = Values::numbers(format!("NPY, {}", format.name()), format, &bytes[start..]);
    let values = if is_of_columns { in_rows(&list.values, &shape) } else { list.values };
    let is_open = hints.size.is_none() && hints.layer.is_none();
    let meant = |(_, planes): &(Vec<usize>, usize)| is_open && hints.channels.is_none_or(|n| n == *planes);
    let list = match planes(size.as_ref()).filter(meant) {
        Some((size, channels)) => Values {
            values: together(&values, channels),
            size: Some((size, channels)),
            kind: format!("{}, channel by channel", list.kind),
            ..list
        },
        None => Values { values, size, channels, ..list },
    };
    Ok(vec![shape::table(file, list, hints)?])
}

/// Size and channels of an array whose first index is the channel: two or three planes are no slices that
/// anything can be told of.
fn planes(size: Option<&(Vec<usize>, usize)>) -> Option<(Vec<usize>, usize)> {
    match size {
        Some((size, 1)) => match size[..] {
            [x, y, channels @ 2..=3] if x > 4 && y > 4 => Some((vec![x, y], channels)),
            _ => None,
        },
        _ => None,
    }
}

/// Values that lie plane by plane with those of a texel together.
fn together(values: &[f64], channels: usize) -> Vec<f64> {
    let texels = values.len() / channels;
    (0..values.len()).map(|i| values[i % channels * texels + i / channels]).collect()
}

/// Values that lie in Fortran's order, the first index fastest, with the last index fastest.
fn in_rows(values: &[f64], shape: &[usize]) -> Vec<f64> {
    let at = |i: usize| {
        let (mut rest, mut at, mut step) = (i, 0, values.len());
        for side in shape.iter().rev() {
            step /= side;
            at += rest % side * step;
            rest /= side;
        }
        values[at]
    };
    (0..values.len()).map(at).collect()
}

/// Refuses a size that contradicts the array's own: a list may be laid out, and rows may be slices
/// one below the other.
fn contradicted(
    source: Source,
    shape: &[usize],
    own: Option<&(Vec<usize>, usize)>,
    hints: &Hints,
) -> Result<(), ForeignError> {
    let (Some(asked), Some((own, channels))) = (&hints.size, own) else { return Ok(()) };
    let long = |size: &[usize]| size.iter().copied().filter(|n| *n != 1).collect::<Vec<usize>>();
    let stacked = match (&long(own)[..], &long(asked)[..]) {
        ([x, rows], [x_asked, y, z]) => x == x_asked && y.checked_mul(*z) == Some(*rows),
        (own, asked) => own.len() < 2 || own == asked,
    };
    if stacked {
        return Ok(());
    }
    let tuple: Vec<String> = shape.iter().map(usize::to_string).collect();
    let message = format!(
        "the array's own shape ({}) lays out as {} texels{} (x first): --size {} contradicts it; leave --size out, or save \
         the array in the shape that is meant",
        tuple.join(", "),
        shape::words(own),
        if *channels == 1 { String::new() } else { format!(" of {channels} channels") },
        asked.iter().map(usize::to_string).collect::<Vec<_>>().join("x"),
    );
    let found = shape.iter().product();
    Err(ForeignError::size(source.file, "", found, &message))
}

/// Where the numbers begin, and the dictionary.
fn dictionary<'a>(source: Source<'a>) -> Result<(usize, &'a str), ForeignError> {
    let version = source.part(6, 2, "the version")?[0];
    let (width, length) = match version {
        1 => {
            let bytes = source.part(PREFIX, 2, "the dictionary's length")?;
            (2, u64::from(u16::from_le_bytes([bytes[0], bytes[1]])))
        }
        2 | 3 => (4, u64::from(source.words::<1>(PREFIX, "the dictionary's length")?[0])),
        n => {
            return Err(source.unsupported(
                6,
                format!("version {n} of the NPY format"),
                "save it with version 1",
            ));
        }
    };
    let bytes = source.part(PREFIX + width, length, "the dictionary")?;
    let text = std::str::from_utf8(bytes);
    let text =
        text.map_err(|_| source.malformed(PREFIX, "the dictionary is no text: the file is damaged"))?;
    Ok(((PREFIX + width + length) as usize, text))
}

fn number(source: Source, kind: &str, hints: &Hints) -> Result<RawFormat, ForeignError> {
    let bits = |integers: &str| {
        let message = format!("{integers} may be bits of numbers or fractions of a whole");
        ForeignError::encoding(source.file, Spot::Byte(PREFIX), "the array", &message)
    };
    match (kind, hints.format) {
        ("<f2", _) => Ok(RawFormat::F16),
        ("<f4", _) => Ok(RawFormat::F32),
        ("<f8", _) => Ok(RawFormat::F64),
        ("|u1", Some(RawFormat::Unorm8)) => Ok(RawFormat::Unorm8),
        ("<u2", Some(format @ (RawFormat::F16 | RawFormat::Unorm16))) => Ok(format),
        ("<u4", Some(RawFormat::F32)) => Ok(RawFormat::F32),
        ("|u1" | "<u2" | "<u4", _) => Err(bits(kind)),
        _ => {
            let what = format!("an array of {}", kind.escape_debug());
            Err(source.unsupported(PREFIX, what, "save it as little-endian float16, float32 or float64"))
        }
    }
}

/// The numbers of `(64, 32)`.
fn extents(source: Source, text: &str) -> Result<Vec<usize>, ForeignError> {
    let bad = || source.malformed(PREFIX, "the shape is no tuple of one to four positive numbers");
    let inner =
        text.strip_prefix('(').and_then(|t| t.split_once(')')).map(|(inner, _)| inner).ok_or_else(bad)?;
    let parts = inner.split(',').map(str::trim).filter(|part| !part.is_empty());
    let shape: Result<Vec<usize>, _> = parts.map(str::parse::<usize>).collect();
    shape.ok().filter(|s| (1..=4).contains(&s.len()) && !s.contains(&0)).ok_or_else(bad)
}
