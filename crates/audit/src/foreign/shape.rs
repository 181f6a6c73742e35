//! A list of values to a table: its size as stated, or as its length tells.

use super::limits::{self, LINE_MAX, SIDE_MIN};
use super::{Channel, ForeignError, ForeignTable, Hints, RawFormat, Step};

/// Values as they lie in a file, the channels of a texel together, with what the file says about
/// them.
pub(super) struct Values {
    /// Name of the array or layer, or empty.
    pub name: String,
    /// What kind of file, in words: `raw f32`.
    pub kind: String,
    /// The values.
    pub values: Vec<f64>,
    /// Size and channels, where the file states them.
    pub size: Option<(Vec<usize>, usize)>,
    /// Channels, where the file states only these.
    pub channels: Option<usize>,
    /// Values on each line of the text and lines, where all lines hold as many.
    pub lines: Option<(usize, usize)>,
    /// What the format rounds to.
    pub step: Step,
}

impl Values {
    /// Numbers of a format that lie one after another, without a word about their size.
    pub fn numbers(kind: String, format: RawFormat, bytes: &[u8]) -> Values {
        Values {
            name: String::new(),
            kind,
            values: format.values(bytes),
            size: None,
            channels: None,
            lines: None,
            step: format.step(),
        }
    }
}

/// The table of a list of values.
pub(super) fn table(file: &str, list: Values, hints: &Hints) -> Result<ForeignTable, ForeignError> {
    let (size, channels) = size(file, &list, hints)?;
    let texels = list.values.len() / channels;
    let channels: Vec<Channel> = (0..channels)
        .map(|c| {
            let values = (0..texels).map(|t| list.values[t * channels + c]).collect::<Vec<_>>();
            Channel { name: c.to_string(), values: values.into() }
        })
        .collect();
    finish(file, list.name, &list.kind, size, channels, list.step)
}

/// The slices of a number of those tables that have three axes.
pub(super) fn slices(
    file: &str,
    tables: Vec<ForeignTable>,
    index: usize,
) -> Result<Vec<ForeignTable>, ForeignError> {
    let depth = |t: &ForeignTable| match t.size[..] {
        [_, _, depth] if depth > 1 => Some(depth),
        _ => None,
    };
    let deepest = tables.iter().filter_map(depth).max();
    let sliced: Vec<ForeignTable> =
        tables.into_iter().filter(|t| depth(t) > Some(index)).map(|t| slice(t, index)).collect();
    match deepest {
        _ if !sliced.is_empty() => Ok(sliced),
        Some(deepest) => {
            Err(ForeignError::new(file, format!("slice {index} is not there: they are 0 to {}", deepest - 1)))
        }
        None => Err(ForeignError::new(
            file,
            format!("no table in it has a third axis, of which {index} could be a slice"),
        )),
    }
}

fn slice(table: ForeignTable, index: usize) -> ForeignTable {
    let texels = table.size[0] * table.size[1];
    let of =
        |c: Channel| Channel { values: c.values[index * texels..(index + 1) * texels].to_vec().into(), ..c };
    ForeignTable {
        name: format!("{}{}slice {index}", table.name, if table.name.is_empty() { "" } else { ", " }),
        what: format!("{}, slice {index} of {}", table.what, table.size[2]),
        size: table.size[..2].to_vec(),
        channels: table.channels.into_iter().map(of).collect(),
        note: String::new(),
        ..table
    }
}

/// A table of channels that have the size's length: refuses values that are not finite.
pub(super) fn finish(
    file: &str,
    name: String,
    kind: &str,
    size: Vec<usize>,
    channels: Vec<Channel>,
    step: Step,
) -> Result<ForeignTable, ForeignError> {
    let names: Vec<&str> = channels.iter().map(|c| c.name.as_str()).collect();
    let plural = if names.len() == 1 { "channel" } else { "channels" };
    let what = format!("{kind}, {}, {plural} {}", words(&size), names.join(" "));
    let table = ForeignTable { file: file.into(), name, what, size, channels, step, note: String::new() };
    finite(&table)?;
    Ok(table)
}

fn finite(table: &ForeignTable) -> Result<(), ForeignError> {
    let bad = |c: &Channel| c.values.iter().filter(|v| !v.is_finite()).count();
    let count: usize = table.channels.iter().map(bad).sum();
    for channel in &table.channels {
        if let Some(index) = channel.values.iter().position(|v| !v.is_finite()) {
            let (texel, name, value) = (place(index, &table.size), &channel.name, channel.values[index]);
            let total = table.channels.len() * table.texels();
            let others = match count - 1 {
                0 => ", the only one".into(),
                1 => ", nor is 1 other".into(),
                n => format!(", nor are {n} others"),
            };
            let message = format!(
                "channel {name}, texel {texel:?}: {value} is not a finite number{others} of {total} values"
            );
            return Err(ForeignError::of(&table.file, &table.name, message));
        }
    }
    Ok(())
}

/// Index along every axis of a flat index, the first axis fastest.
pub(crate) fn place(flat: usize, size: &[usize]) -> Vec<usize> {
    let mut rest = flat;
    size.iter()
        .map(|n| {
            let i = rest % n;
            rest /= n;
            i
        })
        .collect()
}

/// `64 x 64`.
pub(crate) fn words(size: &[usize]) -> String {
    size.iter().map(usize::to_string).collect::<Vec<_>>().join(" x ")
}

/// The size that the caller states, checked on its own: one to three axes, none empty, no more
/// texels than the limit.
pub(super) fn stated(file: &str, size: &[usize]) -> Result<usize, ForeignError> {
    if !(1..=3).contains(&size.len()) || size.contains(&0) {
        let message = format!("cannot be {:?}: a size has one to three axes, none of them empty", size);
        return Err(ForeignError::size(file, "", 0, &message));
    }
    let texels = size.iter().try_fold(1u128, |product, &n| product.checked_mul(n as u128));
    let texels = texels.unwrap_or(u128::MAX);
    if texels > limits::VALUES as u128 {
        let what = format!("texels of {}", words(size));
        return Err(ForeignError::too_large(file, &what, texels, limits::VALUES));
    }
    Ok(texels as usize)
}

/// Size and channels: the caller's word first, then the file's, then what the length allows.
fn size(file: &str, list: &Values, hints: &Hints) -> Result<(Vec<usize>, usize), ForeignError> {
    let found = list.values.len();
    let wrong = |message: String| ForeignError::size(file, &list.name, found, &message);
    if found == 0 {
        return Err(wrong("is no table".into()));
    }
    if let Some(channels) = hints.channels
        && (channels == 0 || channels > limits::CHANNELS || !found.is_multiple_of(channels))
    {
        return Err(wrong(format!("are no whole texels of {channels} channels: state another number")));
    }
    if let Some(size) = &hints.size {
        let texels = stated(file, size)?;
        let channels = hints.channels.unwrap_or(found / texels);
        if channels == 0 || channels > limits::CHANNELS || texels.checked_mul(channels) != Some(found) {
            let channels = hints.channels.map_or(String::new(), |n| format!(" of {n} channels"));
            return Err(wrong(format!(
                "are not {} texels{channels}: state another size (x first), or name another array by --symbol",
                words(size)
            )));
        }
        return Ok((size.clone(), channels));
    }
    match (&list.size, hints.channels) {
        (Some((size, channels)), None) => Ok((size.clone(), *channels)),
        (Some((size, channels)), Some(asked)) if asked == *channels => Ok((size.clone(), asked)),
        (Some((size, channels)), Some(asked)) => regroup(size, *channels, asked).ok_or_else(|| {
            wrong(format!(
                "are {} texels of {channels} channels, not of {asked}: state the size",
                words(size)
            ))
        }),
        (None, channels) => guess(file, list, channels.or(list.channels)),
    }
}

/// Another reading of the same list: the x axis split into texels of `asked` channels.
fn regroup(size: &[usize], channels: usize, asked: usize) -> Option<(Vec<usize>, usize)> {
    let [x, rest @ ..] = size else { return None };
    let row = x * channels;
    if channels != 1 && asked != 1 || !row.is_multiple_of(asked) {
        return None;
    }
    Some(([&[row / asked], rest].concat(), asked))
}

/// Mean magnitude of the difference of values so many places apart: of channels that lie together it is
/// smaller from texel to texel.
fn steps(list: &Values, apart: usize) -> f64 {
    let pairs = list.values.iter().zip(list.values.iter().skip(apart));
    pairs.map(|(a, b)| (a - b).abs()).sum::<f64>() / list.values.len().saturating_sub(apart).max(1) as f64
}

/// Squares of one to three channels, cubes of one; where there is none, squares of four channels
/// and cubes of two to four; short lists may be a line. The lines of a text that are as many and as
/// long as the rows of a square decide between them.
fn guess(file: &str, list: &Values, channels: Option<usize>) -> Result<(Vec<usize>, usize), ForeignError> {
    let found = list.values.len();
    let fits = |power: usize, channels: usize| -> Option<(Vec<usize>, usize)> {
        let texels = found.is_multiple_of(channels).then_some(found / channels)?;
        let side = (SIDE_MIN..=texels).take_while(|n| n.pow(power as u32) <= texels).last()?;
        (side.pow(power as u32) == texels).then(|| (vec![side; power], channels))
    };
    let line = |c: usize| (found <= LINE_MAX * c && found.is_multiple_of(c)).then(|| (vec![found / c], c));
    let readings: Vec<(Vec<usize>, usize)> = match channels {
        Some(c) => [fits(2, c), fits(3, c), line(c)].into_iter().flatten().collect(),
        None => {
            let first = [fits(2, 1), fits(2, 2), fits(2, 3), fits(3, 1), line(1)];
            let second = [fits(2, 4), fits(3, 2), fits(3, 3), fits(3, 4)];
            let mut first: Vec<_> = first.into_iter().flatten().collect();
            // A square of an even side is one of four channels too.
            first.extend(fits(2, 4).filter(|_| !first.is_empty() && 2.0 * steps(list, 4) < steps(list, 1)));
            if first.is_empty() { second.into_iter().flatten().collect() } else { first }
        }
    };
    let laid_out = |(size, channels): &&(Vec<usize>, usize)| {
        size.len() == 2 && list.lines == Some((size[0] * channels, size[1]))
    };
    match (&readings[..], readings.iter().find(laid_out)) {
        (_, Some(one)) | ([one], _) => Ok(one.clone()),
        ([], _) => {
            let message = "are no square, cube or short line: state the size (x first)";
            Err(ForeignError::size(file, &list.name, found, message))
        }
        _ => {
            let words = |(size, c): &(Vec<usize>, usize)| match c {
                1 => words(size),
                c => format!("{} of {c} channels", words(size)),
            };
            let readings = readings.iter().map(words).collect::<Vec<_>>().join(" or ");
            let message = format!(
                "{found} values may be {readings}: state the size (x first) or the number of channels"
            );
            Err(ForeignError::of(file, &list.name, message))
        }
    }
}

/// Size (x fastest) and channels, or only the channels, that nested lists give.
pub(super) type Grouped = (Option<(Vec<usize>, usize)>, Option<usize>);

/// What the extents of nested lists, outermost first, say: the innermost is that of channels if it
/// is a vector's, if it is at most four and the next is longer and at least four, or if there are
/// four; a plain list says nothing, a list of texels only their channels.
pub(super) fn grouped(extents: &[usize], vectors: bool) -> Result<Grouped, String> {
    let small = matches!(extents, [.., next, last] if *last <= 4 && *next >= 4 && next > last);
    let (size, channels) = match extents {
        [size @ .., last] if !size.is_empty() && (vectors || small || extents.len() == 4) => (size, *last),
        size => (size, 1),
    };
    match size {
        [_] if channels == 1 => Ok((None, None)),
        [_] => Ok((None, Some(channels))),
        size if size.len() <= 3 && channels <= limits::CHANNELS => {
            Ok((Some((size.iter().rev().copied().collect(), channels)), None))
        }
        _ => Err(format!("{} is more than three axes of texels", words(extents))),
    }
}
