//! What GLSL and HLSL make only where the left side of `&&` or `||` asks for it, and the front end
//! always.

use crate::foreign::text::{Lexer, Token};

/// The byte of something on the right of `&&` or `||` that changes what others read, within a
/// range, with its name: GLSL makes it only where the left side asks for it, the front end always.
pub(super) fn eager(text: &str, range: [usize; 2], writes: &dyn Fn(&str) -> bool) -> Option<(usize, String)> {
    let text = &text[range[0]..range[1]];
    let bytes = text.as_bytes();
    let pair = |at: usize, c: u8| bytes.get(at) == Some(&c) && bytes.get(at + 1) == Some(&c);
    let mut lexer = Lexer::new(text, "");
    // Depth of brackets at each operator on whose right side the token at hand stands.
    let (mut depth, mut right): (usize, Vec<usize>) = (0, Vec::new());
    let mut last: Option<(usize, &str)> = None;
    while let Some((at, token)) = lexer.next() {
        let inside = !right.is_empty();
        match token {
            Token::Mark(c @ (b'&' | b'|')) if pair(at, c) => right.push(depth),
            Token::Mark(b';') => right.clear(),
            Token::Mark(b',' | b'?' | b':') => right.retain(|d| *d < depth),
            Token::Mark(c @ (b'+' | b'-')) if inside && pair(at, c) => {
                return Some((range[0] + at, "an assignment".into()));
            }
            Token::Mark(b'=') if inside && !compares(bytes, at) => {
                return Some((range[0] + at, "an assignment".into()));
            }
            Token::Open(kind) => {
                if let (b'(', true, Some((at, name))) = (kind, inside, last)
                    && writes(name)
                {
                    return Some((
                        range[0] + at,
                        format!("a call of {name}, which writes variables of others,"),
                    ));
                }
                depth += 1;
            }
            Token::Close(_) => {
                depth = depth.saturating_sub(1);
                right.retain(|d| *d <= depth);
            }
            _ => {}
        }
        last = if let Token::Word(name) = token { Some((at, name)) } else { None };
    }
    None
}

/// Whether `=` at a byte is of `==`, `!=`, `<=` or `>=`, and not of an assignment, as it is in
/// `<<=`.
fn compares(bytes: &[u8], at: usize) -> bool {
    let before = |k: usize| at.checked_sub(k).map(|i| bytes[i]);
    match before(1) {
        Some(b'=' | b'!') => true,
        Some(c @ (b'<' | b'>')) => before(2) != Some(c),
        _ => bytes.get(at + 1) == Some(&b'='),
    }
}
