//! Conditions of WESL: `@if(NAME)`, `@elif(NAME)` and `@else` before a declaration, statement, member
//! or argument.

use super::lex::tokens;
use super::{Bad, Preprocessor, condition};
use crate::foreign::shader::text::Origin;
use crate::foreign::text::{Lexer, Token};

/// A token, its first byte, and the one after its last.
type Part<'a> = (Token<'a>, usize, usize);

impl Preprocessor {
    /// Code with blanks for these attributes, and for what they leave out, byte for byte.
    pub(super) fn attributes(&mut self, part: &str, from: Origin) -> Result<String, Bad> {
        let mut lexer = Lexer::new(part, "");
        let mut parts: Vec<Part> = Vec::new();
        while let Some((at, token)) = lexer.next() {
            if let Some(last) = parts.last_mut() {
                last.2 = at;
            }
            parts.push((token, at, part.len()));
        }
        let mut out = part.as_bytes().to_vec();
        let mut blank = |from: usize, to: usize| {
            let own = out[from..to].iter_mut().filter(|b| **b != b'\n');
            own.for_each(|b| *b = b' ');
        };
        // Whether a part of the chain at hand has been read.
        let (mut k, mut done) = (0, false);
        while k + 1 < parts.len() {
            let word = match (parts[k].0, parts[k + 1].0) {
                (Token::Mark(b'@'), Token::Word(word)) if matches!(word, "if" | "elif" | "else") => word,
                _ => {
                    k += 1;
                    continue;
                }
            };
            let mut end = k + 2;
            let mut holds = true;
            if word != "else" {
                end = closing(&parts, k + 2) + 1;
                let start = parts.get(k + 2).map_or(part.len(), |p| p.1);
                let stop = parts.get(end).map_or(part.len(), |p| p.1);
                let place = Origin { at: from.at + start, ..from };
                holds = condition::holds(&tokens(&part[start..stop], place), &mut self.macros, place)?;
            }
            done = word != "if" && done;
            let kept = holds && !done;
            done |= holds;
            let stop = if kept { end } else { ended(&parts, end) };
            blank(parts[k].1, parts.get(stop).map_or(part.len(), |p| p.1));
            k = stop.max(k + 1);
        }
        Ok(String::from_utf8_lossy(&out).into_owned())
    }
}

/// The token that closes the bracket at a token.
fn closing(parts: &[Part], open: usize) -> usize {
    let mut depth = 0_usize;
    for (k, (token, ..)) in parts.iter().enumerate().skip(open) {
        match token {
            Token::Open(_) => depth += 1,
            Token::Close(_) => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return k;
        }
    }
    parts.len()
}

/// The token after what begins at one: a block, or what a semicolon, a comma or the bracket around
/// ends.
fn ended(parts: &[Part], start: usize) -> usize {
    // Commas between the arguments of a type end nothing.
    let (mut k, mut angle) = (start, 0_usize);
    while let Some((token, ..)) = parts.get(k) {
        match token {
            Token::Open(b'{') => return closing(parts, k) + 1,
            Token::Open(_) => k = closing(parts, k),
            Token::Mark(b'<') => angle += 1,
            Token::Mark(b'>') => angle = angle.saturating_sub(1),
            Token::Mark(b';') => return k + 1,
            Token::Mark(b',') if angle == 0 => return k + 1,
            Token::Close(_) => return k,
            _ => {}
        }
        k += 1;
    }
    parts.len()
}
