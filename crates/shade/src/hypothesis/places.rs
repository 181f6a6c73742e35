//! Where names are declared in a hypothesis's source, by its text: the front end keeps no place of
//! an argument.

use super::Hypothesis;
use crate::Place;

impl Hypothesis {
    /// Where the formula's function is declared.
    pub fn place_of_function(&self) -> Place {
        self.place(function(&code(&self.source)).map(|(name, _)| name))
    }

    /// Where an argument of the formula is declared; its function if it has no such argument.
    pub fn place_of_argument(&self, argument: &str) -> Place {
        let code = code(&self.source);
        let found = function(&code).and_then(|(_, (open, close))| {
            let mut words = words(&code).filter(|(start, end)| *start > open && *end <= close);
            words.find(|(start, end)| code[*start..*end] == *argument)
        });
        found.map_or_else(|| self.place_of_function(), |found| self.place(Some(found)))
    }

    /// Where a free parameter is declared; the formula's function if there is no such parameter.
    pub fn place_of_parameter(&self, parameter: &str) -> Place {
        let code = code(&self.source);
        let all: Vec<(usize, usize)> = words(&code).collect();
        let declared = |pair: &&[(usize, usize)]| {
            [pair[0], pair[1]].map(|(start, end)| &code[start..end]) == ["override", parameter]
        };
        match all.windows(2).find(declared) {
            Some(pair) => self.place(Some(pair[1])),
            None => self.place_of_function(),
        }
    }

    fn place(&self, found: Option<(usize, usize)>) -> Place {
        let (start, end) = found.unwrap_or((0, 0));
        let place = Place::of(&self.file, &self.source, start, end);
        // The name alone: a function's would bring its arguments along.
        Place { excerpt: self.source[start..end].to_string(), ..place }
    }
}

/// The name of the last function, and its parentheses.
fn function(code: &str) -> Option<((usize, usize), (usize, usize))> {
    let all: Vec<(usize, usize)> = words(code).collect();
    let pair = all.windows(2).rev().find(|pair| &code[pair[0].0..pair[0].1] == "fn")?;
    let open = pair[1].1 + code[pair[1].1..].find('(')?;
    let close = open + code[open..].find(')')?;
    Some((pair[1], (open, close)))
}

/// Byte ranges of words.
fn words(code: &str) -> impl Iterator<Item = (usize, usize)> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut at = 0;
    std::iter::from_fn(move || {
        let start = at + code[at..].find(is_word)?;
        let length = code[start..].find(|c| !is_word(c));
        at = length.map_or(code.len(), |length| start + length);
        Some((start, at))
    })
}

/// The source with spaces in the place of comments, byte by byte.
fn code(source: &str) -> String {
    let mut left = source;
    let mut out = String::with_capacity(source.len());
    while let Some(start) = [left.find("//"), left.find("/*")].into_iter().flatten().min() {
        let end = if left[start..].starts_with("//") {
            left[start..].find('\n').map_or(left.len(), |length| start + length)
        } else {
            block(left, start)
        };
        out += &left[..start];
        out.extend(std::iter::repeat_n(' ', end - start));
        left = &left[end..];
    }
    out + left
}

/// The end of a block comment, which may hold others.
fn block(text: &str, start: usize) -> usize {
    let (mut depth, mut at) = (0, start);
    while at < text.len() {
        let rest = &text.as_bytes()[at..];
        if rest.starts_with(b"/*") {
            (depth, at) = (depth + 1, at + 2);
        } else if rest.starts_with(b"*/") {
            (depth, at) = (depth - 1, at + 2);
            if depth == 0 {
                return at;
            }
        } else {
            at += 1;
        }
    }
    text.len()
}
