//! What a scene's names may do in messages: nothing but be read. They reach no generated code.

/// Whether a character could end a line or reorder the text around it where the name is printed:
/// control characters, the Unicode line ends, and the bidirectional controls.
fn acts(c: char) -> bool {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_acts_is_written_out() {
        let hostile = ["a\nb", "\u{1b}[2J", "\u{202e}x", "\u{2028}", "\r", "\u{85}", "\u{7f}", "\u{feff}"];
        for text in hostile {
            let shown = visible(text);
            assert!(shown.contains("\\u{") && !shown.contains(acts), "{shown}");
        }
        assert_eq!(visible("rough metal/wood \\ α = 0.5"), "rough metal/wood \\ α = 0.5");
    }
}
