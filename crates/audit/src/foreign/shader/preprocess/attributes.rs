//! Conditions of WESL: `@if(NAME)`, `@elif(NAME)` and `@else` before a declaration, statement, member
//! or argument.

use super::lex::tokens;
use super::{Bad, Preprocessor, condition};
use crate::foreign::shader::rewrite::{Span, closing, spans};
use crate::foreign::shader::text::Origin;
use crate::foreign::text::Token;

impl Preprocessor {
    /// Code with blanks for these attributes, and for what they leave out, byte for byte.
    pub(super) fn attributes(&mut self, part: &str, from: Origin) -> Result<String, Bad> {
        let spans = spans(part, [0, part.len()]);
        let start_of = |k: usize| spans.get(k).map_or(part.len(), |span| span.start);
        let mut out = part.as_bytes().to_vec();
        let mut blank = |from: usize, to: usize| {
            let own = out[from..to].iter_mut().filter(|b| **b != b'\n');
            own.for_each(|b| *b = b' ');
        };
        // Whether a part of the chain at hand has been read.
        let (mut k, mut done) = (0, false);
        while k + 1 < spans.len() {
            let word = match (spans[k].token, spans[k + 1].token) {
                (Token::Mark(b'@'), Token::Word(word)) if matches!(word, "if" | "elif" | "else") => word,
                _ => {
                    k += 1;
                    continue;
                }
            };
            let mut end = k + 2;
            let mut holds = true;
            if word != "else" {
                end = closing(&spans, k + 2) + 1;
                let (start, stop) = (start_of(k + 2), start_of(end));
                let place = Origin { at: from.at + start, ..from };
                holds = condition::holds(&tokens(&part[start..stop], place), &mut self.macros, place)?;
            }
            done = word != "if" && done;
            let kept = holds && !done;
            done |= holds;
            let stop = if kept { end } else { ended(&spans, end) };
            blank(spans[k].start, start_of(stop));
            k = stop.max(k + 1);
        }
        Ok(String::from_utf8_lossy(&out).into_owned())
    }
}

/// The token after what begins at one: a block, or what a semicolon, a comma or the bracket around
/// ends.
fn ended(spans: &[Span], start: usize) -> usize {
    // Commas between the arguments of a type end nothing.
    let (mut k, mut angle) = (start, 0_usize);
    while let Some(span) = spans.get(k) {
        match span.token {
            Token::Open(b'{') => return closing(spans, k) + 1,
            Token::Open(_) => k = closing(spans, k),
            Token::Mark(b'<') => angle += 1,
            Token::Mark(b'>') => angle = angle.saturating_sub(1),
            Token::Mark(b';') => return k + 1,
            Token::Mark(b',') if angle == 0 => return k + 1,
            Token::Close(_) => return k,
            _ => {}
        }
        k += 1;
    }
    spans.len()
}
