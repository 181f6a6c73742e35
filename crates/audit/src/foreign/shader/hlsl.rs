//! The scalars, vectors and matrices of HLSL (and of Slang, where it is that), rewritten in GLSL word
//! by word: types, intrinsics, casts, initial values, `static const`; attributes and semantics say
//! nothing of values and are left out. What has no counterpart stays as it is, and the front end
//! refuses it at its place.
//!
//! A matrix of HLSL is stored row by row, one of GLSL column by column: the rows of the one are
//! taken as the columns of the other, so that `m[i]` and constructors stay, and `mul(a, b)` is b * a.

use std::collections::BTreeMap;

use super::items::Item;
use super::rewrite::{ENTRY, Span, closing};
use super::text::{Origin, Text};
use crate::foreign::text::Token;

/// Intrinsics that GLSL has by another name.
const INTRINSICS: [(&str, &str); 5] =
    [("lerp", "mix"), ("frac", "fract"), ("rsqrt", "inversesqrt"), ("atan2", "atan"), ("fma", "mad")];

/// Words that say nothing of values.
const SILENT: [&str; 12] = [
    "static",
    "inline",
    "precise",
    "nointerpolation",
    "extern",
    "volatile",
    "row_major",
    "column_major",
    "uniform",
    "in",
    "unorm",
    "snorm",
];

/// The name of a function or type in GLSL.
pub(super) fn renamed(word: &str) -> String {
    if let Some((_, glsl)) = INTRINSICS.iter().find(|(hlsl, _)| *hlsl == word) {
        return (*glsl).to_string();
    }
    typed(word).unwrap_or_else(|| word.to_string())
}

/// The type of GLSL for a numeric type of HLSL.
fn typed(word: &str) -> Option<String> {
    let kinds = [
        ("min16float", "", "float"),
        ("min10float", "", "float"),
        ("float", "", "float"),
        ("half", "", "float"),
        ("min16int", "i", "int"),
        ("int", "i", "int"),
        ("uint", "u", "uint"),
        ("dword", "u", "uint"),
        ("bool", "b", "bool"),
    ];
    kinds.iter().find_map(|(name, letter, scalar)| {
        // Of `float16_t` and others the digits are no size.
        let rest = word.strip_prefix(name)?;
        let size = |c: char| ('2'..='4').contains(&c);
        match rest.as_bytes() {
            [] | [b'1'] => Some((*scalar).to_string()),
            [n] if size(*n as char) => Some(format!("{letter}vec{rest}")),
            [n, b'x', m] if size(*n as char) && size(*m as char) && letter.is_empty() => {
                Some(if n == m { format!("mat{}", *n as char) } else { format!("mat{rest}") })
            }
            _ => None,
        }
    })
}

/// Whether a constructor of a type takes any number or vector.
fn is_wrapped(ty: &str) -> bool {
    !ty.starts_with("mat")
}

/// Adds an item of HLSL in GLSL.
pub(super) fn translate(text: &Text, item: &Item, spans: &[Span], entry: bool, out: &mut Text) {
    let mut to =
        Translator { text, spans, item, entry, types: BTreeMap::new(), result: None, out, body: false };
    to.header();
    to.range(0, spans.len());
    // A structure may end at its brace.
    if !item.function && spans.last().is_some_and(|last| last.token == Token::Close(b'}')) {
        to.put(";", spans.len() - 1);
    }
    if item.body && !entry {
        to.defaults();
    }
}

struct Translator<'a> {
    text: &'a Text,
    spans: &'a [Span<'a>],
    item: &'a Item,
    entry: bool,
    /// Types of the variables that have been declared.
    types: BTreeMap<&'a str, String>,
    /// Type of the result.
    result: Option<String>,
    out: &'a mut Text,
    /// Whether the body of the function has begun, or there is none.
    body: bool,
}

/// Most default values that a call may leave out.
const DEFAULTS: usize = 16;

impl<'a> Translator<'a> {
    fn token(&self, k: usize) -> Option<Token<'a>> {
        self.spans.get(k).map(|s| s.token)
    }

    fn word(&self, k: usize) -> &'a str {
        self.spans.get(k).and_then(Span::word).unwrap_or("")
    }

    fn is_word(&self, k: usize) -> bool {
        matches!(self.token(k), Some(Token::Word(_)))
    }

    fn put(&mut self, words: &str, k: usize) {
        let at = self.spans.get(k.min(self.spans.len().saturating_sub(1))).map_or(0, |s| s.start);
        let from: Origin = self.text.origin(at);
        self.out.put(words, from);
    }

    fn take(&mut self, k: usize) {
        let span = self.spans[k];
        self.out.take(self.text, [span.start, span.end]);
    }

    /// Types of the result and of the arguments.
    fn header(&mut self) {
        self.body = !self.item.function;
        if !self.item.function {
            return;
        }
        let name = (0..self.spans.len()).find(|k| self.word(*k) == self.item.name());
        self.result = name.and_then(|k| k.checked_sub(1)).and_then(|k| typed(self.word(k)));
        let end = (0..self.spans.len()).find(|k| self.token(*k) == Some(Token::Open(b'{')));
        for k in name.unwrap_or(0)..end.unwrap_or(self.spans.len()) {
            if let Some(ty) = typed(self.word(k)).filter(|_| self.is_word(k + 1)) {
                self.types.insert(self.word(k + 1), ty);
            }
        }
    }

    /// Overloads without the last arguments, for calls that leave up to [`DEFAULTS`] to their default values.
    fn defaults(&mut self) {
        let brace = (0..self.spans.len()).find(|k| self.token(*k) == Some(Token::Open(b'{')));
        let header = 0..brace.unwrap_or(0);
        let Some(open) = header.clone().find(|k| self.token(*k) == Some(Token::Open(b'('))) else { return };
        let (mut arguments, mut k) = (Vec::new(), open + 1);
        while k < header.end && self.token(k) != Some(Token::Close(b')')) {
            let stop = self.expression(k, header.end);
            let value = (k..stop).find(|k| self.token(*k) == Some(Token::Mark(b'=')));
            arguments.push((k, value.unwrap_or(stop), stop));
            if self.token(stop) != Some(Token::Mark(b',')) {
                break;
            }
            k = stop + 1;
        }
        let first = arguments.iter().position(|(_, value, stop)| value < stop).unwrap_or(arguments.len());
        // Each overload is written out: no function of people has so many.
        let first = first.max(arguments.len().saturating_sub(DEFAULTS));
        for given in first..arguments.len() {
            self.body = false;
            self.range(0, open + 1);
            for (i, (start, value, _)) in arguments[..given].iter().enumerate() {
                self.put(if i > 0 { ", " } else { "" }, *start);
                self.range(*start, *value);
            }
            self.put(if open > 1 && self.word(open - 2) == "void" { ") { " } else { ") { return " }, open);
            self.put(&format!("{}(", self.item.name()), open);
            self.body = true;
            for (i, (_, value, stop)) in arguments.iter().enumerate() {
                self.put(if i > 0 { ", " } else { "" }, *value);
                let name = self.word(value - 1);
                match self.types.get(name).cloned().filter(|_| i >= given) {
                    Some(ty) => self.value(&ty, value + 1, *stop),
                    None if i >= given => self.range(value + 1, *stop),
                    None => self.put(name, *value),
                }
            }
            self.put("); }\n", open);
        }
    }

    fn closing(&self, open: usize, end: usize) -> usize {
        closing(&self.spans[..end], open)
    }

    /// The end of an expression: the next semicolon, comma or closing bracket outside of its own.
    fn expression(&self, start: usize, end: usize) -> usize {
        let mut k = start;
        while k < end {
            match self.token(k) {
                Some(Token::Open(_)) => k = self.closing(k, end),
                Some(Token::Close(_) | Token::Mark(b';' | b',')) => return k,
                _ => {}
            }
            k += 1;
        }
        end
    }

    /// Whether a statement begins at a token.
    fn begins(&self, k: usize) -> bool {
        match k.checked_sub(1).and_then(|b| self.token(b)) {
            None | Some(Token::Mark(b';') | Token::Open(b'{') | Token::Close(b'}')) => true,
            Some(Token::Open(b'(')) => k >= 2 && self.word(k - 2) == "for",
            Some(Token::Close(b']')) => typed(self.word(k)).is_some(),
            Some(Token::Close(b')')) => self.body && self.is_word(k),
            Some(Token::Word(word)) => SILENT.contains(&word) || matches!(word, "const" | "else"),
            _ => false,
        }
    }

    fn range(&mut self, start: usize, end: usize) {
        let mut k = start;
        while k < end {
            k = self.one(k, end);
        }
    }

    /// Translates what begins at a token; the next.
    fn one(&mut self, k: usize, end: usize) -> usize {
        let token = self.spans[k].token;
        let outer = self.item.function && !self.body;
        match token {
            Token::Open(b'{') => {
                self.body = true;
                self.take(k);
                k + 1
            }
            // An attribute.
            Token::Open(b'[') if self.begins(k) && self.spans.len() > k + 1 => self.closing(k, end) + 1,
            Token::Open(b'(') => self.bracket(k, end),
            // A semantic.
            Token::Mark(b':') if outer || self.is_semantic(k) => k + 2,
            // The default value of an argument.
            Token::Mark(b'=') if outer => self.expression(k + 1, end),
            Token::Number(_) => {
                let span = self.spans[k];
                let written = &self.text.as_str()[span.start..span.end];
                let bare = written.trim_end();
                let hex = bare.starts_with("0x") || bare.starts_with("0X");
                let cut = if hex { bare } else { bare.trim_end_matches(['h', 'H', 'l', 'L']) };
                self.out.take(self.text, [span.start, span.start + cut.len()]);
                self.put(&written[bare.len()..], k);
                k + 1
            }
            Token::Word(word) => self.named(k, word, end),
            _ => {
                self.take(k);
                k + 1
            }
        }
    }

    /// Whether a colon stands before the semantic of a member, or what a structure inherits.
    fn is_semantic(&self, k: usize) -> bool {
        let ends = matches!(self.token(k + 2), Some(Token::Mark(b';') | Token::Open(b'{')));
        !self.item.function && self.word(0) == "struct" && ends
    }

    /// A cast, or any other bracket.
    fn bracket(&mut self, k: usize, end: usize) -> usize {
        let called = k.checked_sub(1).map_or("", |b| self.word(b));
        let cast = typed(self.word(k + 1))
            .filter(|_| self.token(k + 2) == Some(Token::Close(b')')) && matches!(called, "" | "return"));
        let Some(ty) = cast else {
            self.take(k);
            return k + 1;
        };
        let mut at = k + 3;
        while matches!(self.token(at), Some(Token::Mark(b'-' | b'+' | b'!' | b'~'))) && at < end {
            at += 1;
        }
        // Casts of casts.
        while matches!(self.token(at), Some(Token::Open(b'(')))
            && typed(self.word(at + 1)).is_some()
            && self.token(at + 2) == Some(Token::Close(b')'))
        {
            at += 3;
        }
        at = match self.token(at) {
            Some(Token::Open(_)) => self.closing(at, end) + 1,
            _ => at + 1,
        };
        loop {
            match self.token(at) {
                Some(Token::Open(b'(' | b'[')) if at < end => at = self.closing(at, end) + 1,
                Some(Token::Mark(b'.')) if at < end => at += 2,
                _ => break,
            }
        }
        self.put(&format!("{ty}("), k);
        self.range(k + 3, at.min(end));
        self.put(")", at.min(end) - 1);
        at.min(end)
    }

    fn named(&mut self, k: usize, word: &'a str, end: usize) -> usize {
        let outer = self.item.function && !self.body;
        if SILENT.contains(&word) || outer && word == "const" {
            return k + 1;
        }
        if outer && self.entry && word == self.item.name() {
            self.put(ENTRY, k);
            self.put(" ", k);
            return k + 1;
        }
        let assigns = self.token(k + 1) == Some(Token::Mark(b'='))
            && self.token(k + 2) != Some(Token::Mark(b'='))
            && self.begins(k);
        if word == "return"
            && let Some(ty) = self.result.clone().filter(|ty| is_wrapped(ty))
        {
            let stop = self.expression(k + 1, end);
            if stop > k + 1 {
                self.put("return ", k);
                self.value(&ty, k + 1, stop);
                return stop;
            }
        }
        if assigns
            && self.body
            && let Some(ty) = self.types.get(word).cloned()
        {
            let stop = self.expression(k + 2, end);
            self.take(k);
            self.take(k + 1);
            self.value(&ty, k + 2, stop);
            return stop;
        }
        if let Some(ty) = typed(word) {
            if self.begins(k) && self.body && self.is_word(k + 1) {
                return self.declaration(k, &ty, end);
            }
            self.put(&ty, k);
            self.put(" ", k);
            return k + 1;
        }
        let member = k.checked_sub(1).and_then(|b| self.token(b)) == Some(Token::Mark(b'.'));
        if self.token(k + 1) == Some(Token::Open(b'(')) && !member {
            self.put(&renamed(word), k);
        } else {
            self.take(k);
        }
        k + 1
    }

    /// A value of a type: numbers and vectors become it.
    fn value(&mut self, ty: &str, start: usize, end: usize) {
        if self.token(start) == Some(Token::Open(b'{')) {
            return self.list(ty, start, end);
        }
        let wrapped = is_wrapped(ty);
        if wrapped {
            self.put(&format!("{ty}("), start);
        }
        self.range(start, end);
        if wrapped {
            self.put(")", end - 1);
        }
    }

    /// A list of initial values as a constructor.
    fn list(&mut self, ty: &str, start: usize, end: usize) {
        let close = self.closing(start, end);
        self.put(&format!("{ty}("), start);
        let inner = ty.split_once('[').map(|(base, _)| base.to_string());
        let mut k = start + 1;
        while k < close {
            let stop = self.expression(k, close);
            match &inner {
                Some(base) => self.value(base, k, stop),
                None => self.range(k, stop),
            }
            let more = self.token(stop) == Some(Token::Mark(b',')) && stop + 1 < close;
            if more {
                self.put(", ", stop);
            }
            k = stop + 1;
        }
        self.put(")", close);
    }

    /// A declaration of numbers, its initial values of their type.
    fn declaration(&mut self, k: usize, ty: &str, end: usize) -> usize {
        self.put(ty, k);
        self.put(" ", k);
        let mut at = k + 1;
        while at < end && self.is_word(at) {
            let name = self.word(at);
            self.take(at);
            at += 1;
            let mut ty = ty.to_string();
            if self.token(at) == Some(Token::Open(b'[')) {
                let close = self.closing(at, end);
                let (from, to) = (self.spans[at].start, self.spans[close.min(end - 1)].end);
                ty = format!("{ty}{}", self.text.as_str()[from..to].trim());
                self.range(at, (close + 1).min(end));
                at = close + 1;
            } else {
                self.types.insert(name, ty.clone());
            }
            if self.token(at) == Some(Token::Mark(b'=')) {
                let stop = self.expression(at + 1, end);
                self.take(at);
                self.value(&ty, at + 1, stop);
                at = stop;
            }
            if self.token(at) != Some(Token::Mark(b',')) {
                break;
            }
            self.take(at);
            at += 1;
        }
        at
    }
}
