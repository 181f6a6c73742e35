//! Items in the words that naga's front ends read: what says nothing of values is taken out.

use super::items::Item;
use super::text::Text;
use super::{ShaderLanguage, hlsl};
use crate::foreign::text::{Lexer, Token};

/// The name that the function asked for has in what the front end is given: its overloads keep
/// theirs.
pub(super) const ENTRY: &str = "lobefit_entry";

/// A token with its first byte, and the first byte of the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span<'a> {
    pub token: Token<'a>,
    pub start: usize,
    pub end: usize,
}

impl<'a> Span<'a> {
    pub fn word(&self) -> Option<&'a str> {
        if let Token::Word(word) = self.token { Some(word) } else { None }
    }
}

/// The tokens of a part of a text.
pub(super) fn spans(text: &str, [start, end]: [usize; 2]) -> Vec<Span<'_>> {
    let mut lexer = Lexer::new(&text[start..end], "");
    let mut found: Vec<Span> = Vec::new();
    while let Some((at, token)) = lexer.next() {
        if let Some(last) = found.last_mut() {
            last.end = start + at;
        }
        found.push(Span { token, start: start + at, end });
    }
    found
}

/// The token that closes the bracket at a token, or the end.
pub(super) fn closing(spans: &[Span], open: usize) -> usize {
    let mut depth = 0_usize;
    for (k, span) in spans.iter().enumerate().skip(open) {
        match span.token {
            Token::Open(_) => depth += 1,
            Token::Close(_) => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return k;
        }
    }
    spans.len()
}

/// Adds an item to what the front end is given.
pub(super) fn rewrite(text: &Text, item: &Item, entry: bool, language: ShaderLanguage, out: &mut Text) {
    let mut spans = spans(text.as_str(), item.range);
    // A path to a name: names are not kept apart by module.
    let qualified: Vec<bool> = (0..spans.len())
        .map(|k| {
            let path = |k: usize| spans.get(k).is_some_and(|s| s.token == Token::Mark(b'p'));
            path(k) || spans[k].word().is_some() && path(k + 1)
        })
        .collect();
    let mut kept = qualified.iter();
    spans.retain(|_| kept.next() == Some(&false));
    if language == ShaderLanguage::Hlsl {
        hlsl::translate(text, item, &spans, entry, out);
    } else {
        let (mut depth, mut body) = (0_usize, !item.function);
        for (k, span) in spans.iter().enumerate() {
            match span.token {
                Token::Open(kind) => {
                    body |= kind == b'{';
                    depth += 1;
                }
                Token::Close(_) => depth = depth.saturating_sub(1),
                _ => {}
            }
            let argument = depth == 1 && !body;
            let word = span.word().unwrap_or("");
            let name = entry && depth == 0 && !body && word == item.name();
            let precision = matches!(word, "highp" | "mediump" | "lowp" | "precise" | "invariant");
            let plain = precision || argument && (word == "const" || word == "void" && spans.len() > k + 1);
            if name {
                out.put(ENTRY, text.origin(span.start));
                out.put(" ", text.origin(span.start));
            } else if language == ShaderLanguage::Wgsl || !plain {
                out.take(text, [span.start, span.end]);
            }
        }
    }
    out.put("\n", text.origin(item.range[0]));
}
