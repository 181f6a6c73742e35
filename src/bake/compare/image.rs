//! Tables: texel against texel.

use std::iter::successors;
use std::ops::Range;

use super::{Difference, Kind, text};
use crate::bake::BakedTable;
use crate::data::{Channel, Table, TexelFormat};
use crate::emit::container::SIDECAR;
use crate::emit::exr::{self, Decoded};
use crate::emit::sidecar::Sidecar;
use crate::store::Files;

/// How two EXR files differ; `table` is that of the recipe.
pub fn different(table: &BakedTable, file: &str, expected: &[u8], found: &[u8]) -> Difference {
    let part = part(expected, expected.iter().zip(found).take_while(|(want, have)| want == have).count());
    let misstated = misstated(expected, found);
    let (expected, found) = match (exr::decode(expected), exr::decode(found)) {
        (Ok(expected), Ok(found)) => (expected, found),
        (_, Err(error)) | (Err(error), _) => {
            return Difference::plain(file, Kind::Different, &format!("{part}: {error}"));
        }
    };
    if shape(&expected) != shape(&found) {
        let (want, have) = (words(&expected), words(&found));
        return Difference::plain(file, Kind::Different, &format!("{have} where the recipe gives {want}"));
    }
    let format = table.table().map_or(TexelFormat::F32, |t| t.format);
    let mut difference = judged(table, format, file, &expected, &found);
    if difference.max_abs == Some(0.0) {
        difference.detail = format!("{part}; texels are equal");
    }
    if let Some(words) = misstated {
        difference.detail = format!("{words}; {}", difference.detail);
        difference.max_abs = None;
    }
    difference
}

/// What of an EXR file holds a byte: an attribute of its header, by name, or the byte itself.
fn part(file: &[u8], at: usize) -> String {
    let mut behind_magic = attributes(file).filter(|_| at >= MAGIC);
    let holds = behind_magic.find(|(_, value)| at < value.end);
    holds.map_or_else(|| format!("byte {at}"), |(name, _)| format!("header: attribute `{name}`"))
}

/// What the attributes of a file say wrongly: the first number that no tolerance forgives.
fn misstated(expected: &[u8], found: &[u8]) -> Option<String> {
    let text = |file: &[u8], value: &Range<usize>| {
        let value = file.get(value.clone()).unwrap_or_default();
        String::from_utf8_lossy(value).into_owned()
    };
    let found: Vec<(String, String)> =
        attributes(found).map(|(name, value)| (name, text(found, &value))).collect();
    attributes(expected).find_map(|(name, value)| {
        let (_, has) = found.iter().find(|(other, _)| *other == name)?;
        let words = text::misstated(&text(expected, &value), has)?;
        Some(format!("header: attribute `{name}`: {words}"))
    })
}

/// Bytes before the first attribute: magic number and version.
const MAGIC: usize = 8;

/// The attributes of an EXR file: their names and where their values stand.
fn attributes(file: &[u8]) -> impl Iterator<Item = (String, Range<usize>)> + '_ {
    // Each: name, type, both ended by 0, length, value.
    let text = move |from: usize| file.get(from..)?.split(|byte| *byte == 0).next();
    let attribute = move |from: usize| {
        let name = text(from).filter(|name| !name.is_empty())?;
        let length = from + name.len() + 1;
        let length = length + text(length)?.len() + 1;
        let value: &[u8; 4] = file.get(length..)?.first_chunk()?;
        let start = length + 4;
        Some((String::from_utf8_lossy(name).into_owned(), start..start + u32::from_le_bytes(*value) as usize))
    };
    successors(attribute(MAGIC), move |(_, value)| attribute(value.end))
}

/// Whether a table holds the same texels in two sets of files: an EXR by its channels, another format by
/// what follows the header, whose length its sidecar states.
pub fn is_same(file: &str, files: &Files, found: &Files) -> bool {
    let texels = |files: &Files| {
        let sidecar: Sidecar = serde_json::from_slice(files.get(&format!("{file}{SIDECAR}"))?).ok()?;
        let channels = (sidecar.size, sidecar.channels, sidecar.stored);
        Some((files.get(file)?.get(sidecar.offset..)?.to_vec(), channels))
    };
    match [files, found].map(|files| files.get(file).map(|bytes| exr::decode(bytes))) {
        [Some(Ok(new)), Some(Ok(old))] => shape(&new) == shape(&old) && new.channels == old.channels,
        _ => texels(files).is_some() && texels(files) == texels(found),
    }
}

/// How the texels of two images of one shape, stored in `format`, differ: the texel that is
/// furthest off, and whether those found still keep the stated error.
pub fn judged(
    table: &BakedTable,
    format: TexelFormat,
    file: &str,
    expected: &Decoded,
    found: &Decoded,
) -> Difference {
    let mut difference = texels(file, expected, found, (format, table.table()));
    if difference.max_abs != Some(0.0) {
        // So the order of texels is the table's.
        let again = |channels: &[Channel]| table.measured_again(channels).map_err(|e| e.to_string());
        difference.judge(table.errors.lookup.max, &found.channels, again);
    }
    difference
}

type Shape<'a> = (usize, usize, Vec<&'a str>);

fn shape(image: &Decoded) -> Shape<'_> {
    (image.width, image.height, image.channels.iter().map(|c| c.name.as_str()).collect())
}

fn words(image: &Decoded) -> String {
    let names: Vec<&str> = image.channels.iter().map(|c| c.name.as_str()).collect();
    format!("{} x {} texels of {}", image.width, image.height, names.join(", "))
}

/// The texel that is furthest off, by its places along the axes of the table: slices lie one below the other.
fn texels(
    file: &str,
    expected: &Decoded,
    found: &Decoded,
    (format, table): (TexelFormat, Option<&Table>),
) -> Difference {
    let mut difference = Difference::plain(file, Kind::Different, "texels are equal");
    difference.max_abs = Some(0.0);
    let mut count = 0;
    for (want, have) in expected.channels.iter().zip(&found.channels) {
        for (i, (a, b)) in want.texels.iter().zip(&have.texels).enumerate().filter(|(_, (a, b))| a != b) {
            count += 1;
            let gap = (a - b).abs();
            // NaN is the largest difference there is.
            if gap.is_nan() || gap > difference.max_abs.unwrap_or(0.0) {
                let along =
                    table.map_or_else(|| vec![i % expected.width, i / expected.width], |t| t.place(i));
                let words = ["column ", "row ", "slice ", "", ""];
                let cell: Vec<String> =
                    words.iter().zip(along).map(|(word, k)| format!("{word}{k}")).collect();
                let cell = cell.join(", ");
                let place = format!("channel {}, {cell}", want.name);
                difference.detail = format!("{place}: {b} where the recipe gives {a}");
                (difference.max_abs, difference.at) = (Some(gap), Some(place));
            }
            difference.max_ulp = difference.max_ulp.max(Some(ulps(*a, *b, format)));
        }
    }
    if let (Some(gap), Some(ulps)) = (difference.max_abs, difference.max_ulp) {
        let texels = if count == 1 { "texel differs" } else { "texels differ" };
        difference.detail += &format!("; {count} {texels}, max abs {gap:e}, max ulp {ulps}");
    }
    difference
}

/// Distance in representable numbers of the texel format.
fn ulps(a: f64, b: f64, format: TexelFormat) -> u64 {
    let index = |x: f64| match format {
        TexelFormat::Unorm8 => (255.0 * x).round() as i64,
        TexelFormat::Unorm16 => (65535.0 * x).round() as i64,
        TexelFormat::F16 => ordered(u64::from(half::f16::from_f64(x).to_bits()), 15),
        TexelFormat::F32 => ordered(u64::from((x as f32).to_bits()), 31),
    };
    index(a).abs_diff(index(b))
}

/// Sign-magnitude bits to integers in the order of their values.
fn ordered(bits: u64, sign: u32) -> i64 {
    let magnitude = (bits & ((1 << sign) - 1)) as i64;
    if bits >> sign == 1 { -magnitude } else { magnitude }
}
