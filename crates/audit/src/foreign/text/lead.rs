//! The name and the sizes that a declaration gives to the array literal after it.

use super::lex::{Lexer, Token};

/// Longest declaration that is read, bytes: what stands before is not part of a name.
const LONGEST: usize = 2000;

/// What stands before a literal.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Lead {
    /// The declared name, or empty.
    pub name: String,
    /// Sizes declared after the name, `[32][32]`, outermost first; 0 where a size is none that can
    /// be read.
    pub sizes: Vec<usize>,
}

/// Reads the text between the beginning of a statement and the literal.
pub(super) fn lead(text: &str, file: &str, statement: usize, open: usize) -> Lead {
    let mut start = statement.max(open.saturating_sub(LONGEST));
    while !text.is_char_boundary(start) {
        start += 1;
    }
    let mut lexer = Lexer::new(&text[start..open], file);
    let tokens: Vec<Token> = std::iter::from_fn(|| lexer.next()).map(|(_, token)| token).collect();
    let tokens = declarator(&tokens);
    let mut lead = Lead::default();
    let mut depth = 0usize;
    for (i, token) in tokens.iter().enumerate() {
        match token {
            Token::Open(b'[') if depth == 0 && !lead.name.is_empty() => {
                lead.sizes.push(size(&tokens[i + 1..]));
                depth += 1;
            }
            Token::Open(_) => depth += 1,
            Token::Close(_) => depth = depth.saturating_sub(1),
            Token::Word(word) if depth == 0 => {
                lead = Lead { name: (*word).to_string(), sizes: Vec::new() };
            }
            _ => {}
        }
    }
    lead
}

/// The tokens that declare: before the last `=`, and before the type after a colon.
fn declarator<'t, 'a>(tokens: &'t [Token<'a>]) -> &'t [Token<'a>] {
    let equals = tokens.iter().rposition(|t| *t == Token::Mark(b'='));
    let tokens = &tokens[..equals.unwrap_or(tokens.len())];
    let colon = tokens.iter().position(|t| *t == Token::Mark(b':'));
    &tokens[..colon.unwrap_or(tokens.len())]
}

/// The number that a bracket of a declaration holds, if it holds just one.
fn size(tokens: &[Token]) -> usize {
    match tokens {
        [Token::Number(n), Token::Close(b']'), ..] if n.decimals.is_none() && n.value < 4294967296.0 => {
            n.value as usize
        }
        _ => 0,
    }
}
