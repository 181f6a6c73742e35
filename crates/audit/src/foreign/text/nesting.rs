//! How deep the expressions of a text nest: what a parser that recurses will need of its stack.

use super::lex::{Lexer, Token};

/// Most operators and brackets on the way from a statement to a term. Arguments of one bracket are
/// beside each other, not inside.
pub(in crate::foreign) fn nesting(text: &str, file: &str) -> usize {
    let mut lexer = Lexer::new(text, file);
    // Operators since the last comma or semicolon, for each bracket that is open, the outermost
    // being the text itself.
    let (mut open, mut sum, mut deepest) = (vec![0usize], 0usize, 0);
    while let Some((_, token)) = lexer.next() {
        let operator = match token {
            // An index is applied to what stands before it; a member too.
            Token::Open(b'[') | Token::Word("else") => 1,
            Token::Mark(b',' | b';') => 0,
            Token::Mark(_) => 1,
            _ => 0,
        };
        sum += operator;
        if let Some(top) = open.last_mut() {
            *top += operator;
        }
        match token {
            Token::Open(_) => open.push(0),
            Token::Close(_) if open.len() > 1 => sum -= open.pop().unwrap_or_default(),
            Token::Mark(b',' | b';') => sum -= open.last_mut().map_or(0, std::mem::take),
            _ => {}
        }
        deepest = deepest.max(sum + open.len() - 1);
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_inside_counts_and_what_is_beside_does_not() {
        let depth = |text: &str| nesting(text, "t.glsl");
        assert_eq!(depth("a + b * c; d - e;"), 2);
        assert_eq!(depth("f(a + b, c + d, e * g)"), 2);
        assert_eq!(depth("-(-(-(x)))"), 6);
        assert_eq!(depth(&format!("f({});", vec!["vec2(1, -2)"; 5000].join(", "))), 3);
        assert_eq!(depth(&"(".repeat(2000)), 2000);
        assert_eq!(depth(&"if (x) {} else ".repeat(300)), 300);
        assert_eq!(depth(&"f(a, ".repeat(2000)), 2000);
        assert_eq!(depth(&format!("a{};", ".x".repeat(2000))), 2000);
        assert_eq!(depth(&format!("a{};", "[0]".repeat(2000))), 2001);
        assert_eq!(depth(&"float f(float x) { return x; }\n".repeat(2000)), 1);
        assert_eq!(depth("// ((((\n/* (((( */ )))) ,"), 0);
    }
}
