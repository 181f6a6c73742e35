//! What a scene's names may do in messages, comments and identifiers of generated code: nothing but be read.

/// Whether a character could end a line or reorder the text around it where the name is printed: control characters,
/// the Unicode line ends that WGSL and JavaScript honour in comments, and the bidirectional controls.
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

/// The text for a comment in any of the emitted languages: one line, no comment delimiter, no backslash (which joins
/// lines in C and HLSL), nothing that reorders.
pub fn comment(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let chars: Vec<char> = text.chars().collect();
    for (i, &c) in chars.iter().enumerate() {
        let neighbour =
            |j: Option<usize>| j.and_then(|j| chars.get(j)).is_none_or(|n| matches!(n, '*' | '/'));
        let delimits = c == '/' && (neighbour(i.checked_sub(1)) || neighbour(i.checked_add(1)));
        if acts(c) || c == '\\' || delimits { out.extend(c.escape_unicode()) } else { out.push(c) }
    }
    out
}

/// An identifier made of the text: ASCII letters, digits and underscores, lower case, never a leading digit and never
/// empty. Two texts may share one; the caller checks for that.
pub fn identifier(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 1);
    for c in text.chars() {
        out.push(if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' });
    }
    if out.is_empty() || out.starts_with(|c: char| c.is_ascii_digit()) {
        out.insert(0, '_');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_cannot_be_left() {
        for hostile in
            ["a\nb", "a*/b", "/*", "//", "tail\\", "\u{202e}x", "\u{2028}", "\r", "\u{85}", "\u{7f}"]
        {
            let text = comment(hostile);
            assert!(!text.contains(['\n', '\r', '/', '\u{2028}', '\u{202e}', '\u{85}']), "{text}");
            assert!(!text.ends_with('\\'), "{text}");
        }
        assert_eq!(comment("metal/wood"), "metal/wood");
        assert_eq!(comment("rough metal, α = 0.5"), "rough metal, α = 0.5");
    }

    #[test]
    fn identifiers_are_identifiers() {
        assert_eq!(identifier("a-b"), "a_b");
        assert_eq!(identifier("9Lives"), "_9lives");
        assert_eq!(identifier(""), "_");
        assert_eq!(identifier("É"), "_");
    }
}
