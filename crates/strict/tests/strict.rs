//! Limits, places and words of messages.

use lobefit_strict::escape::{acts, visible};
use lobefit_strict::number::{In, Numbers, Unit};
use lobefit_strict::{Position, SceneError, limits, place, refused};

fn accept<'a>(bytes: &'a [u8], file: &str) -> Result<&'a str, SceneError> {
    lobefit_strict::accept(bytes, file, limits::STRING_BYTES)
}

#[test]
fn depth_holds_at_the_limit_only() {
    let nested = |n: usize| "[".repeat(n) + &"]".repeat(n);
    assert!(accept(nested(limits::DEPTH).as_bytes(), "s").is_ok());
    for n in [limits::DEPTH + 1, 100_000] {
        let error = accept(nested(n).as_bytes(), "s").unwrap_err();
        assert_eq!(error.to_string(), "s:1:65: nested deeper than 64 levels");
    }
    // Brackets in strings do not nest.
    assert!(accept(format!("\"{}\"", "[".repeat(1000)).as_bytes(), "s").is_ok());
}

#[test]
fn strings_hold_at_the_limit_only() {
    let quoted = |n: usize| format!("[\"{}\"]", "x".repeat(n));
    assert!(accept(quoted(limits::STRING_BYTES).as_bytes(), "s").is_ok());
    for n in [limits::STRING_BYTES + 1, 10 << 20] {
        let error = accept(quoted(n).as_bytes(), "s").unwrap_err();
        assert_eq!(error.to_string(), "s:1:2: a string longer than 4096 bytes");
    }
}

#[test]
fn files_hold_at_the_limit_only() {
    let padded = |n: u64| {
        let mut text = vec![b' '; n as usize];
        text[0] = b'1';
        text
    };
    assert!(accept(&padded(limits::FILE_BYTES), "s").is_ok());
    let error = accept(&padded(limits::FILE_BYTES + 1), "s").unwrap_err();
    assert_eq!(error.to_string(), "s: the file is larger than 16777216 bytes");
}

#[test]
fn positions_count_from_one() {
    let error = refused(b"ab\ncd", "s", 4, String::new());
    assert!(matches!(error, SceneError::Text { at: Position { line: 2, column: 2 }, .. }), "{error}");
    let error = accept(b"{\n \xff}", "s").unwrap_err();
    assert!(error.to_string().starts_with("s:2:2: "), "{error}");
}

fn at(text: &str, path: &str) -> Option<(usize, usize)> {
    place(text.as_bytes(), path).map(|Position { line, column }| (line, column))
}

#[test]
fn places_are_of_what_is_there() {
    let text = "{\"a\": {\"b\": [10, 20]},\n \"c\": 7, \"d\": {}}";
    assert_eq!(at(text, "a.b[0]"), Some((1, 15)));
    assert_eq!(at(text, "a.b[1]"), Some((1, 19)));
    assert_eq!(at(text, "c"), Some((2, 7)));
    // Whatever follows a bracket, and whatever a text holds.
    let text = "{ \"a\" :\r\n [  {  \n \"b\": \"{\" }, { } ] , \"c\": [ [ ] ] }";
    let places = ["a", "a[0]", "a[0].b", "a[1]", "c", "c[0]"].map(|path| at(text, path));
    assert_eq!(places, [(2, 2), (2, 5), (3, 9), (3, 14), (3, 27), (3, 29)].map(Some));
}

/// What is absent has no place, whatever follows it; nor has what no step can name.
#[test]
fn what_is_absent_has_no_place() {
    let text = "{\"a\": {\"b\": [10, 20], \"c\": 1}, \"d\": 7}";
    for path in ["e", "a.d", "a.b[2]", "a.b[9]"] {
        assert_eq!(at(text, path), None, "{path}");
    }
    assert_eq!((at("{ }", "a"), at("{ }", "a.b[3]"), at("[ ]", "[0]")), (None, None, None));
    assert_eq!(at("{\"a\": 1, \"b\": 2}", "b.c"), None);
    assert_eq!(at(text, "a.b[x]"), None);
}

/// A number too many is refused as that, in the interval or not, and whatever it is.
#[test]
fn a_number_too_many_is_counted_and_not_judged() {
    for more in ["0.5", "4", "\"x\"", "[]"] {
        let text = format!("[0.1, 0.2, {more}]");
        let found = serde_json::from_str::<Numbers<In<Unit>, 2, false>>(&text).map(|_| ());
        let message = found.unwrap_err().to_string();
        assert!(message.starts_with("more than 2 numbers"), "{text}: {message}");
    }
    let few = serde_json::from_str::<Numbers<In<Unit>, 2, false>>("[0.1]").map(|_| ());
    assert!(few.unwrap_err().to_string().starts_with("1 number where 2 are called for"));
}

#[test]
fn what_acts_is_written_out() {
    let hostile = ["a\nb", "\u{1b}[2J", "\u{202e}x", "\u{2028}", "\r", "\u{85}", "\u{7f}", "\u{feff}"];
    for text in hostile {
        let shown = visible(text);
        assert!(shown.contains("\\u{") && !shown.contains(acts), "{shown}");
    }
    assert_eq!(visible("rough metal/wood \\ α = 0.5"), "rough metal/wood \\ α = 0.5");
}
