//! Tokens of the preprocessor: names, numbers, characters; comments are blanks.

use crate::foreign::shader::text::Origin;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Name,
    Number,
    Blank,
    Mark,
}

/// A token and where it comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Token {
    pub kind: Kind,
    pub text: String,
    pub from: Origin,
    /// Whether it stands in a file as it is, and is not of a macro's body.
    pub copied: bool,
}

impl Token {
    pub fn is(&self, text: &str) -> bool {
        self.text == text
    }
}

/// The tokens of a part of a file that begins at `from`; comments have been blanked.
pub(super) fn tokens(part: &str, from: Origin) -> Vec<Token> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(first) = part[at..].chars().next() {
        let rest = &part[at..];
        let run = |keep: &dyn Fn(char) -> bool| rest.find(|c| !keep(c)).unwrap_or(rest.len());
        let word = |c: char| c.is_alphanumeric() || c == '_' || c == '$';
        let next = rest.as_bytes().get(1).copied().unwrap_or(b' ');
        let (kind, length) = match first {
            c if c.is_whitespace() => (Kind::Blank, run(&|c| c.is_whitespace())),
            c if c.is_ascii_digit() || c == '.' && next.is_ascii_digit() => (Kind::Number, number(rest)),
            c if word(c) => (Kind::Name, run(&word)),
            '#' if next == b'#' => (Kind::Mark, 2),
            c => (Kind::Mark, c.len_utf8()),
        };
        let text = rest[..length].to_string();
        found.push(Token { kind, text, from: Origin { at: from.at + at, ..from }, copied: true });
        at += length;
    }
    found
}

/// Length of a number with its exponent and suffix.
fn number(rest: &str) -> usize {
    let bytes = rest.as_bytes();
    let mut end = 0;
    while let Some(&c) = bytes.get(end) {
        let exponent = matches!(c, b'+' | b'-')
            && matches!(bytes[end - 1], b'e' | b'E')
            && !rest.starts_with("0x")
            && !rest.starts_with("0X");
        // A swizzle after a number is none: `1.xxx` is a number and a suffix to the front end too.
        if !(c.is_ascii_alphanumeric() || c == b'.' || c == b'_' || exponent) {
            break;
        }
        end += 1;
    }
    end
}

/// The text with blanks for its comments, byte for byte; ends of lines stay.
pub(super) fn without_comments(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('/') {
        let comment = &rest[at..];
        let length = match comment.as_bytes().get(1) {
            Some(b'/') => comment.find('\n').unwrap_or(comment.len()),
            Some(b'*') => comment[2..].find("*/").map_or(comment.len(), |end| end + 4),
            _ => 0,
        };
        out.push_str(&rest[..at]);
        out.extend(comment[..length].bytes().map(|b| if b == b'\n' { '\n' } else { ' ' }));
        if length == 0 {
            out.push('/');
        }
        rest = &comment[length.max(1)..];
    }
    out + rest
}
