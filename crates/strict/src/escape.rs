//! What a scene's names may do in messages: nothing but be read. They reach no generated code.

/// Whether a character could end a line or reorder the text around it where the name is printed:
/// control characters, the Unicode line ends, and the bidirectional controls.
pub fn acts(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{200e}' | '\u{200f}' | '\u{061c}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}')
}

/// The text with every acting character written as `\u{..}`, for terminals and messages.
pub fn visible(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if acts(c) { out.extend(c.escape_unicode()) } else { out.push(c) }
    }
    out
}
