//! Text files: lines, and within them numbers against numbers.

use super::{Difference, Kind, plain};

/// How two texts differ: by the largest difference of their numbers if all else is equal, else by their first differing line.
pub fn different(file: &str, expected: &[u8], found: &[u8]) -> Difference {
    let (Ok(expected), Ok(found)) = (std::str::from_utf8(expected), std::str::from_utf8(found)) else {
        return plain(file, Kind::Different, "different bytes; not text");
    };
    let mut difference = plain(file, Kind::Different, "");
    match worst_number(expected, found) {
        Some((line, want, have)) => {
            let gap = (want - have).abs();
            difference.detail =
                format!("line {line}: {have} where the recipe gives {want}; max abs difference {gap:e}");
            (difference.max_abs, difference.at) = (Some(gap), Some(format!("line {line}")));
        }
        None => {
            let (line, want, have) = first_line(expected, found);
            difference.detail = format!("line {line}: `{have}` where the recipe gives `{want}`");
            difference.at = Some(format!("line {line}"));
        }
    }
    difference
}

/// The pair of numbers that differ most, with its line, if nothing but numbers differs.
fn worst_number(expected: &str, found: &str) -> Option<(usize, f64, f64)> {
    if expected.lines().count() != found.lines().count() {
        return None;
    }
    let mut worst: Option<(usize, f64, f64)> = None;
    for (i, (want, have)) in expected.lines().zip(found.lines()).enumerate() {
        let (want, have) = (tokens(want), tokens(have));
        if want.len() != have.len() {
            return None;
        }
        for (a, b) in want.iter().zip(&have).filter(|(a, b)| a != b) {
            let (a, b) = (a.parse::<f64>().ok()?, b.parse::<f64>().ok()?);
            if worst.is_none_or(|(_, x, y)| (a - b).abs() > (x - y).abs()) {
                worst = Some((i + 1, a, b));
            }
        }
    }
    worst
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

/// The first differing line, cut to a readable length.
fn first_line(expected: &str, found: &str) -> (usize, String, String) {
    const END: &str = "(end of file)";
    let (mut want, mut have) = (expected.lines(), found.lines());
    let mut line = 1;
    loop {
        match (want.next(), have.next()) {
            (a, b) if a == b && a.is_some() => line += 1,
            (a, b) => return (line, cut(a.unwrap_or(END)), cut(b.unwrap_or(END))),
        }
    }
}

fn cut(line: &str) -> String {
    const MOST: usize = 120;
    if line.chars().count() <= MOST {
        line.to_string()
    } else {
        line.chars().take(MOST).chain("...".chars()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_told_by_their_distance() {
        let d = different("a.rs", b"x1 = 0.5;\ny = -2.5e-3\n", b"x1 = 0.5;\ny = -2.25e-3\n");
        assert_eq!(d.at.as_deref(), Some("line 2"));
        assert!((d.max_abs.expect("numbers") - 2.5e-4).abs() < 1e-18, "{d:?}");
    }

    #[test]
    fn names_and_lines_are_not_numbers() {
        let d = different("a.rs", b"fn q13()\n", b"fn q14()\n");
        assert_eq!(
            (d.max_abs, d.detail.as_str()),
            (None, "line 1: `fn q14()` where the recipe gives `fn q13()`")
        );
        let d = different("a.rs", b"one\ntwo\n", b"one\n");
        assert!(d.detail.contains("(end of file)"), "{d:?}");
        assert!(different("a.rs", b"\xff", b"a").detail.contains("not text"));
    }
}
