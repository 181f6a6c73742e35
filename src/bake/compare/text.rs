//! Text files: lines, and within them numbers against numbers.

use super::{Difference, Kind};
use crate::store::MANIFEST;

/// The lines of an include file that are no comments.
pub fn code(bytes: &[u8]) -> Vec<&[u8]> {
    let lines = bytes.split(|byte| *byte == b'\n');
    lines.filter(|line| !line.trim_ascii_start().starts_with(b"//")).collect()
}

/// A number that is another in two texts.
struct Pair {
    line: usize,
    want: f64,
    have: f64,
}

impl Pair {
    fn gap(&self) -> f64 {
        (self.want - self.have).abs()
    }
}

/// How two texts differ: by a constant of a function or an error that is stated smaller than it is, which
/// no tolerance forgives; else by the largest difference of their numbers if all else is equal, else by
/// their first differing line, else by the first line whose end differs.
pub fn different(file: &str, expected: &[u8], found: &[u8]) -> Difference {
    let (Ok(expected), Ok(found)) = (std::str::from_utf8(expected), std::str::from_utf8(found)) else {
        let at = expected.iter().zip(found).take_while(|(want, have)| want == have).count();
        return Difference::plain(file, Kind::Different, &format!("byte {at}: different bytes; not text"));
    };
    let mut difference = Difference::plain(file, Kind::Different, "");
    let pairs = pairs(expected, found).unwrap_or_default();
    let constants = constants(file, expected);
    let constant = pairs.iter().find(|pair| pair.gap() != 0.0 && constants[pair.line - 1]);
    let promises = promises(file, expected);
    let broken = pairs.iter().find(|pair| pair.have < pair.want && promises[pair.line - 1]);
    // NaN is the largest difference there is.
    let worst = pairs.iter().min_by(|a, b| b.gap().total_cmp(&a.gap()));
    match constant.or(broken).or(worst) {
        Some(pair @ Pair { line, want, have }) => {
            let (gap, place) = (pair.gap(), format!("line {line}"));
            let size = match (constant, broken) {
                (Some(_), _) => {
                    format!("a constant of a function, {gap:e} off: no tolerance holds for constants")
                }
                (None, Some(_)) => {
                    format!("a smaller error than is true, by {gap:e}: no tolerance holds for promises")
                }
                (None, None) => format!("max abs difference {gap:e}"),
            };
            difference.detail = format!("{place}: {have} where the recipe gives {want}; {size}");
            difference.max_abs = constant.or(broken).is_none().then_some(gap);
            difference.at = Some(place);
        }
        None => {
            let (place, words) = first_line(expected, found);
            difference.detail = format!("{place}: {words}");
            difference.at = Some(place);
        }
    }
    difference
}

/// Whether each line holds constants of functions: the code of an include file, and coefficients in the
/// manifest.
fn constants(file: &str, text: &str) -> Vec<bool> {
    let is_code = file.starts_with("fits/");
    let mut inside = false;
    let mut holds = |line: &str| {
        inside = match line {
            "\"coefficients\": {" => true,
            "}" | "}," => false,
            _ => inside,
        };
        inside || is_code && !line.starts_with("//")
    };
    text.lines().map(|line| holds(line.trim())).collect()
}

/// Keys of the manifest whose numbers are errors.
const ERRORS: [&str; 5] = ["\"max\":", "\"max_abs\":", "\"max_rel\":", "\"max_error\":", "\"rms\":"];

/// Whether each line states an error: of the manifest by its key, which the end of an axis has too, before
/// its beginning; of an include file in a comment.
fn promises(file: &str, text: &str) -> Vec<bool> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let ends_axis = |i: usize| lines.get(i + 1).is_some_and(|next| next.starts_with("\"min\":"));
    let states = |(i, line): (usize, &&str)| match file {
        MANIFEST => ERRORS.iter().any(|key| line.starts_with(key)) && !ends_axis(i),
        _ => file.starts_with("fits/") && line.starts_with("//") && line.contains("max "),
    };
    lines.iter().enumerate().map(states).collect()
}

/// The numbers that differ, with their lines, if nothing else does.
fn pairs(expected: &str, found: &str) -> Option<Vec<Pair>> {
    if expected.lines().count() != found.lines().count() {
        return None;
    }
    let mut all = Vec::new();
    for (i, (want, have)) in expected.lines().zip(found.lines()).enumerate() {
        let (want, have) = (tokens(want), tokens(have));
        if want.len() != have.len() {
            return None;
        }
        for (a, b) in want.iter().zip(&have).filter(|(a, b)| a != b) {
            all.push(Pair { line: i + 1, want: a.parse().ok()?, have: b.parse().ok()? });
        }
    }
    Some(all)
}

/// A line cut into numbers and what stands between them. A digit behind a letter belongs to a name.
fn tokens(line: &str) -> Vec<&str> {
    let bytes = line.as_bytes();
    let mut tokens = Vec::new();
    let (mut start, mut i) = (0, 0);
    while i < bytes.len() {
        let inside_name = i > 0 && (bytes[i - 1].is_ascii_alphanumeric() || bytes[i - 1] == b'_');
        let signed = bytes[i] == b'-' && bytes.get(i + 1).is_some_and(u8::is_ascii_digit);
        if (bytes[i].is_ascii_digit() || signed) && !inside_name {
            tokens.push(&line[start..i]);
            let end = number_end(bytes, i);
            tokens.push(&line[i..end]);
            (start, i) = (end, end);
        } else {
            i += 1;
        }
    }
    tokens.push(&line[start..]);
    tokens
}

fn number_end(bytes: &[u8], start: usize) -> usize {
    let mut i = start + 1;
    while i < bytes.len() {
        let exponent_sign = (bytes[i] == b'-' || bytes[i] == b'+') && matches!(bytes[i - 1], b'e' | b'E');
        if !(bytes[i].is_ascii_digit() || matches!(bytes[i], b'.' | b'e' | b'E') || exponent_sign) {
            break;
        }
        i += 1;
    }
    i
}

/// The first differing line, cut to a readable length, and of a long one the column; where all lines are
/// equal, the first whose end is another.
fn first_line(expected: &str, found: &str) -> (String, String) {
    const END: &str = "(end of file)";
    let (mut want, mut have) = (expected.lines(), found.lines());
    let mut line = 1;
    loop {
        match (want.next(), have.next()) {
            (None, None) => return first_end(expected, found),
            (a, b) if a == b => line += 1,
            (a, b) => {
                let (want, have) = (a.unwrap_or(END), b.unwrap_or(END));
                let equal = want.chars().zip(have.chars()).take_while(|(a, b)| a == b).count();
                let is_long = [want, have].iter().any(|line| line.chars().count() > MOST);
                let skipped = if is_long { equal.saturating_sub(MOST / 3) } else { 0 };
                let column = if skipped > 0 { format!(", column {}", equal + 1) } else { String::new() };
                let [want, have] = [want, have].map(|line| cut(line, skipped));
                return (format!("line {line}{column}"), format!("`{have}` where the recipe gives `{want}`"));
            }
        }
    }
}

/// The first line that ends otherwise, of texts whose lines are equal.
fn first_end(expected: &str, found: &str) -> (String, String) {
    let (want, have) = (expected.split_inclusive('\n').map(end), found.split_inclusive('\n').map(end));
    let differing = want.zip(have).enumerate().find(|(_, (want, have))| want != have);
    let (i, (want, have)) = differing.unwrap_or((0, ("another end", "one end")));
    (format!("line {}", i + 1), format!("only line ends differ: {have} where the recipe gives {want}"))
}

/// How a line ends.
fn end(line: &str) -> &'static str {
    match line.as_bytes() {
        [.., b'\r', b'\n'] => "CR LF",
        [.., b'\n'] => "LF",
        _ => "no final newline",
    }
}

/// Most characters of a line that are shown.
const MOST: usize = 120;

/// A line without its first characters, cut to a readable length.
fn cut(line: &str, skipped: usize) -> String {
    let (before, after) = (skipped > 0, line.chars().count() > skipped + MOST);
    let dots = |is_cut: bool| if is_cut { "..." } else { "" };
    let shown: String = line.chars().skip(skipped).take(MOST).collect();
    format!("{}{shown}{}", dots(before), dots(after))
}
