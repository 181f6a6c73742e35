//! Text files: lines, and within them numbers against numbers.

use super::{Difference, Kind};
use crate::emit::container::SIDECAR;
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
    role: Role,
}

/// What a number is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// A constant of a function, or what says how texels are read.
    Constant,
    /// An error that is stated of a function or a table.
    Error,
    /// An end of a range that errors hold over, or of an axis.
    Range,
    /// What else is measured or counted.
    Value,
}

impl Pair {
    fn gap(&self) -> f64 {
        (self.want - self.have).abs()
    }

    /// Why no tolerance forgives it.
    fn unforgiven(&self) -> Option<String> {
        let gap = self.gap();
        match self.role {
            Role::Constant => Some(format!("a constant, {gap:e} off: no tolerance holds for constants")),
            Role::Range => Some(format!("an end of a range, {gap:e} off: no tolerance holds for ranges")),
            Role::Error if self.have < self.want => {
                Some(format!("a smaller error than is true, by {gap:e}: no tolerance holds for promises"))
            }
            Role::Error | Role::Value => None,
        }
    }
}

/// How two texts differ: by a constant of a function, an end of a range or an error that is stated smaller
/// than it is, which no tolerance forgives; else by the largest difference of their numbers if all else is
/// equal, else by their first differing line, else by the first line whose end differs.
pub fn different(file: &str, expected: &[u8], found: &[u8]) -> Difference {
    let (Ok(expected), Ok(found)) = (std::str::from_utf8(expected), std::str::from_utf8(found)) else {
        let at = expected.iter().zip(found).take_while(|(want, have)| want == have).count();
        return Difference::plain(file, Kind::Different, &format!("byte {at}: different bytes; not text"));
    };
    let mut difference = Difference::plain(file, Kind::Different, "");
    let pairs = pairs(Document::of(file), expected, found).unwrap_or_default();
    // NaN is the largest difference there is.
    let worst = pairs.iter().min_by(|a, b| b.gap().total_cmp(&a.gap()));
    match unforgiven(&pairs).or(worst) {
        Some(pair @ Pair { line, want, have, .. }) => {
            let (gap, place, why) = (pair.gap(), format!("line {line}"), pair.unforgiven());
            difference.max_abs = why.is_none().then_some(gap);
            let size = why.unwrap_or_else(|| format!("max abs difference {gap:e}"));
            difference.detail = format!("{place}: {have} where the recipe gives {want}; {size}");
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

/// What the header of a table says wrongly: the first number that no tolerance forgives. Lines that differ
/// in more than numbers are of who made it.
pub fn misstated(expected: &str, found: &str) -> Option<String> {
    let mut roles = Roles::new(Document::Header);
    let lines = expected.lines().zip(found.lines()).enumerate();
    let pairs = lines.filter_map(|(i, (want, have))| of_line(i + 1, &roles.next(want), want, have));
    let pairs: Vec<Pair> = pairs.flatten().collect();
    let pair @ Pair { want, have, .. } = unforgiven(&pairs)?;
    Some(format!("{have} where the recipe gives {want}; {}", pair.unforgiven()?))
}

/// The first number that no tolerance forgives, constants before others.
fn unforgiven(pairs: &[Pair]) -> Option<&Pair> {
    let mut all = pairs.iter().filter(|pair| pair.gap() != 0.0 && pair.unforgiven().is_some());
    all.clone().find(|pair| pair.role == Role::Constant).or_else(|| all.next())
}

/// Texts in which numbers have roles.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Document {
    Manifest,
    Sidecar,
    Include,
    Header,
    Other,
}

impl Document {
    fn of(file: &str) -> Document {
        match file.split_once('/') {
            None if file == MANIFEST => Document::Manifest,
            Some(("tables", name)) if name.ends_with(SIDECAR) => Document::Sidecar,
            Some(("fits", _)) => Document::Include,
            _ => Document::Other,
        }
    }
}

/// Keys of the manifest and of sidecars whose numbers are errors.
const ERRORS: [&str; 5] = ["max", "max_abs", "max_rel", "max_error", "rms"];

/// The numbers of a text by their roles, line after line.
struct Roles {
    document: Document,
    /// Of JSON, the keys of what the line stands in.
    keys: Vec<String>,
}

/// The numbers of a line.
enum Line {
    /// All of one role.
    All(Role),
    /// Of prose: each has that which the words before it give.
    Prose,
}

impl Line {
    /// The role of the number behind this part of the line.
    fn role(&self, before: &str) -> Role {
        match self {
            Line::All(role) => *role,
            Line::Prose if ["max ", "rms "].iter().any(|word| before.ends_with(word)) => Role::Error,
            Line::Prose if before.rfind('[') > before.rfind(']') => Role::Range,
            Line::Prose => Role::Value,
        }
    }
}

impl Roles {
    fn new(document: Document) -> Roles {
        Roles { document, keys: Vec::new() }
    }

    /// Of the next line.
    fn next(&mut self, line: &str) -> Line {
        let line = line.trim();
        match self.document {
            Document::Include if !line.starts_with("//") => Line::All(Role::Constant),
            Document::Include => Line::Prose,
            Document::Header => of_header(line),
            Document::Manifest | Document::Sidecar => self.of_json(line),
            Document::Other => Line::All(Role::Value),
        }
    }

    fn of_json(&mut self, line: &str) -> Line {
        if line.starts_with(['}', ']']) {
            self.keys.pop();
        }
        let key = line.strip_prefix('"').and_then(|rest| rest.split_once("\": ")).map_or("", |(key, _)| key);
        let within = |name: &str| self.keys.iter().any(|key| key == name);
        let measured = within("certificate") || within("half");
        let of_header = within("header").then(|| of_header(line.trim_matches(['"', ',', ' '])));
        let role = if within("domain") || within("axes") {
            Role::Range
        } else if within("coefficients") || (self.document == Document::Sidecar && !measured) {
            Role::Constant
        } else if ERRORS.contains(&key) {
            Role::Error
        } else {
            Role::Value
        };
        if line.ends_with(['{', '[']) {
            self.keys.push(key.into());
        }
        of_header.unwrap_or(Line::All(role))
    }
}

/// Of the header of a table: how its texels are read, but for what is measured of it.
fn of_header(line: &str) -> Line {
    let measured = ["error ", "worst ", "domain"].iter().any(|word| line.starts_with(word));
    if measured { Line::Prose } else { Line::All(Role::Constant) }
}

/// The numbers that differ, if nothing else does.
fn pairs(document: Document, expected: &str, found: &str) -> Option<Vec<Pair>> {
    if expected.lines().count() != found.lines().count() {
        return None;
    }
    let mut roles = Roles::new(document);
    let lines = expected.lines().zip(found.lines()).enumerate();
    let pairs = lines.map(|(i, (want, have))| of_line(i + 1, &roles.next(want), want, have));
    Some(pairs.collect::<Option<Vec<_>>>()?.into_iter().flatten().collect())
}

/// Those of a line.
fn of_line(line: usize, roles: &Line, want: &str, have: &str) -> Option<Vec<Pair>> {
    let (wanted, had) = (tokens(want), tokens(have));
    if wanted.len() != had.len() {
        return None;
    }
    let mut before = 0;
    let mut pairs = Vec::new();
    for (a, b) in wanted.iter().zip(&had) {
        if a != b {
            let role = roles.role(&want[..before]);
            pairs.push(Pair { line, want: a.parse().ok()?, have: b.parse().ok()?, role });
        }
        before += a.len();
    }
    Some(pairs)
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
