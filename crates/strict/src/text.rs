//! The look at a scene's bytes before JSON sees them: length, encoding, nesting, comments, length
//! of strings.

use super::error::{Position, SceneError};
use super::limits;

/// The bytes as text, once they are known to be UTF-8 within the limits on length, nesting and
/// strings, which have at most `longest` bytes.
///
/// # Errors
/// A file beyond a limit, one with a comment, and as [`plain`].
pub fn accept<'a>(bytes: &'a [u8], file: &str, longest: usize) -> Result<&'a str, SceneError> {
    let text = plain(bytes, file, "; an object begins with `{`")?;
    nesting(bytes, longest).map_err(|(at, message)| refused(bytes, file, at, message))?;
    Ok(text)
}

/// The bytes as text of at most [`FILE_BYTES`](limits::FILE_BYTES) bytes; `instead` is what a message
/// about an empty file goes on with.
///
/// # Errors
/// A file that is larger, empty or not UTF-8.
pub fn plain<'a>(bytes: &'a [u8], file: &str, instead: &str) -> Result<&'a str, SceneError> {
    if bytes.len() as u64 > limits::FILE_BYTES {
        return Err(SceneError::TooLarge { file: file.into(), limit: limits::FILE_BYTES });
    }
    encoding(bytes, instead).map_err(|message| refused(bytes, file, 0, message))?;
    std::str::from_utf8(bytes).map_err(|e| {
        let message = "this byte is not UTF-8; save the file as UTF-8".into();
        refused(bytes, file, e.valid_up_to(), message)
    })
}

/// What is said of a byte of a file.
pub fn refused(bytes: &[u8], file: &str, at: usize, message: String) -> SceneError {
    SceneError::Text { file: file.into(), at: position(bytes, at), message }
}

/// Refuses what is no UTF-8 text from its first bytes on.
fn encoding(bytes: &[u8], instead: &str) -> Result<(), String> {
    match bytes {
        [0xef, 0xbb, 0xbf, ..] => {
            Err("the file begins with a byte order mark; save it as UTF-8 without one".into())
        }
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] | [0, _, ..] | [_, 0, ..] => {
            Err("the file looks like UTF-16 or UTF-32; save it as UTF-8".into())
        }
        _ if bytes.iter().all(u8::is_ascii_whitespace) => Err(format!("the file is empty{instead}")),
        _ => Ok(()),
    }
}

/// Follows brackets and strings only, so that hostile nesting never reaches a recursive parser; a
/// comment between them is named.
fn nesting(bytes: &[u8], longest: usize) -> Result<(), (usize, String)> {
    let (mut depth, mut i) = (0, 0);
    while i < bytes.len() {
        match bytes[i] {
            b'{' | b'[' if depth == limits::DEPTH => {
                return Err((i, format!("nested deeper than {} levels", limits::DEPTH)));
            }
            b'{' | b'[' => depth += 1,
            b'}' | b']' => depth = depth.saturating_sub(1),
            b'"' => i = string_end(bytes, i, longest)?,
            b'#' => return Err((i, comment("#"))),
            b'/' if bytes.get(i + 1) == Some(&b'/') => return Err((i, comment("//"))),
            b'/' if bytes.get(i + 1) == Some(&b'*') => return Err((i, comment("/*"))),
            _ => {}
        }
        i += 1;
    }
    Ok(())
}

/// What to do about a comment. A scene is hashed, and its JSON is read by scripts and checked by
/// `lobefit schema`: it has one grammar, which every reader knows.
fn comment(mark: &str) -> String {
    format!(
        "`{mark}` begins a comment; a scene is strict JSON, without comments: delete it, or keep the commented file beside the scene and \
         give what is left without comments on standard input (`-`)"
    )
}

/// Index of the closing quote of the string that opens at `start` (the end of the file where there
/// is none).
fn string_end(bytes: &[u8], start: usize, longest: usize) -> Result<usize, (usize, String)> {
    let mut i = start + 1;
    while i < bytes.len() && bytes[i] != b'"' {
        i += if bytes[i] == b'\\' { 2 } else { 1 };
        if i.min(bytes.len()) - (start + 1) > longest {
            return Err((start, format!("a string longer than {longest} bytes")));
        }
    }
    Ok(i)
}

/// Line and column of byte `at`.
fn position(bytes: &[u8], at: usize) -> Position {
    let before = &bytes[..at.min(bytes.len())];
    let line_start = before.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
    Position { line: 1 + before.iter().filter(|&&b| b == b'\n').count(), column: 1 + at - line_start }
}
