//! Limits on the size of a hypothesis: a formula that a shader evaluates per pixel is small, a
//! source that is not is a mistake or an attack on the parser's stack.

use crate::ShadeError;

/// The limits on the size of a hypothesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits;

impl Limits {
    /// Bytes of source.
    pub const SOURCE: usize = 64 << 10;
    /// Free parameters.
    pub const PARAMETERS: usize = 64;
    /// Operations of the formula, calls expanded, common sub-expressions once.
    pub const OPERATIONS: usize = 4096;
    /// Of a function of a [`Source`](crate::Source), its loops and calls written out.
    pub const SOURCE_OPERATIONS: usize = 1 << 15;
    /// Operators and brackets of one statement; bounds how deep an expression can nest.
    pub const STATEMENT: usize = 1024;
    /// Nested branches.
    pub const DEPTH: usize = 64;
}

/// What ends a line comment (WGSL, "Blankspace and Line Breaks").
const LINE_ENDS: [char; 7] = ['\n', '\r', '\u{0b}', '\u{0c}', '\u{85}', '\u{2028}', '\u{2029}'];

/// Refuses sources beyond the limits that can be seen before parsing.
pub(super) fn check(file: &str, source: &str) -> Result<(), ShadeError> {
    refuse(file, "bytes of source", source.len(), Limits::SOURCE)?;
    refuse(file, "operators and brackets in one statement", longest_statement(source), Limits::STATEMENT)
}

/// [`ShadeError::TooLarge`] if `found` is beyond `limit`.
pub(super) fn refuse(file: &str, what: &'static str, found: usize, limit: usize) -> Result<(), ShadeError> {
    if found > limit {
        return Err(ShadeError::TooLarge { file: file.to_string(), what, found, limit });
    }
    Ok(())
}

/// Largest number of operators and brackets between two of `; { }`, comments left out.
fn longest_statement(source: &str) -> usize {
    let bytes = source.as_bytes();
    let (mut longest, mut count, mut at) = (0, 0, 0);
    while at < bytes.len() {
        if bytes[at..].starts_with(b"//") {
            at = source[at..].find(LINE_ENDS).map_or(bytes.len(), |n| at + n);
            continue;
        }
        if bytes[at..].starts_with(b"/*") {
            at = after_block_comment(bytes, at);
            continue;
        }
        match bytes[at] {
            b';' | b'{' | b'}' => count = 0,
            b'+' | b'-' | b'*' | b'/' | b'%' | b'(' | b'[' | b'<' | b'>' | b'&' | b'|' | b'^' | b'='
            | b'!' | b'~' => count += 1,
            _ => {}
        }
        longest = longest.max(count);
        at += 1;
    }
    longest
}

/// The byte after the comment that starts at `at`; WGSL's block comments nest.
fn after_block_comment(bytes: &[u8], mut at: usize) -> usize {
    let mut depth = 0;
    while at < bytes.len() {
        if bytes[at..].starts_with(b"/*") {
            depth += 1;
            at += 2;
        } else if bytes[at..].starts_with(b"*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += 1;
        }
    }
    at
}
