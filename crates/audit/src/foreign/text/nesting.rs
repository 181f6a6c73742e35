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
