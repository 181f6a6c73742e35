//! Text from elsewhere as comments. What a person wrote may not end the comment, hide code from its
//! reader, or swallow the line after it.

/// Lines behind a comment mark, none ending in blanks. Control characters, line and paragraph
/// separators, and the controls of writing direction become their escapes, as does what splices
/// lines in the languages of C's family: a backslash at the end of a line, and its trigraph `??/`.
pub fn comment(mark: &str, lines: &[String]) -> String {
    lines.iter().map(|line| format!("{mark} {}", escaped(line)).trim_end().to_string() + "\n").collect()
}

fn escaped(line: &str) -> String {
    let mut text = String::new();
    for c in line.chars() {
        if hostile(c) { text.extend(c.escape_unicode()) } else { text.push(c) }
    }
    let end = text.trim_end().len();
    text.truncate(end);
    for (splice, safe) in [("\\", "\\u{5c}"), ("??/", "??\\u{2f}")] {
        if let Some(rest) = text.strip_suffix(splice) {
            text = format!("{rest}{safe}");
        }
    }
    text
}

/// Controls; U+2028 and U+2029, which end lines in WGSL; the marks, embeddings, overrides and
/// isolates of the bidirectional algorithm (Unicode Standard Annex 9), and the byte order mark.
fn hostile(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_ends_a_comment_but_its_line() {
        for (line, expected) in [
            ("plain, \u{3b1} = r\u{b2}", "// plain, \u{3b1} = r\u{b2}\n"),
            ("", "//\n"),
            ("two\nlines\r", "// two\\u{a}lines\\u{d}\n"),
            ("next \u{85}\u{2028}", "// next \\u{85}\\u{2028}\n"),
            ("right \u{202e} to left", "// right \\u{202e} to left\n"),
            ("splice \\", "// splice \\u{5c}\n"),
            ("splice \\  ", "// splice \\u{5c}\n"),
            ("splice ??/", "// splice ??\\u{2f}\n"),
            ("C:\\path\\name */ // is safe", "// C:\\path\\name */ // is safe\n"),
        ] {
            assert_eq!(comment("//", &[line.to_string()]), expected);
        }
    }
}
