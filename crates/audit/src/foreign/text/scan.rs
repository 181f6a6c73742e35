//! One pass over a program text for the brackets that hold nothing but numbers: array literals.
//!
//! Invariant: brackets that hold something else lie outside those that do not, so the open brackets
//! that may still become literals are the innermost ones, and `values` holds their numbers only.

use super::frame::{Frame, Literal};
use super::lex::{Lexer, Number, Token};
use super::words::{is_maker, is_scalar_type, is_vector, not_finite};
use crate::foreign::{ForeignError, Spot, limits};

/// Most literals of a text.
const LITERALS: usize = 4096;

struct Scan<'a> {
    text: &'a str,
    file: &'a str,
    frames: Vec<Frame>,
    /// Numbers of the brackets that may become literals.
    values: Vec<f64>,
    literals: Vec<Literal>,
    /// The word before here, nothing but generic arguments between.
    word: Option<&'a str>,
    last: Token<'a>,
    /// Depth of `<` after a word that makes arrays.
    generic: usize,
}

/// The array literals of a text with at least [`limits::ARRAY_MIN`] values, in order. A text that
/// is nothing but numbers is one.
pub(super) fn literals(text: &str, file: &str) -> Result<Vec<Literal>, ForeignError> {
    let mut scan = Scan {
        text,
        file,
        frames: vec![Frame::new(0, 0, b'0')],
        values: Vec::new(),
        literals: Vec::new(),
        word: None,
        last: Token::Mark(b';'),
        generic: 0,
    };
    let mut lexer = Lexer::new(text, file);
    while let Some((at, token)) = lexer.next() {
        if scan.generic == 0 || !scan.in_generic(token) {
            scan.token(at, token)?;
        }
        scan.last = token;
    }
    scan.end()?;
    scan.literals.sort_by_key(|l| l.open);
    Ok(scan.literals)
}

impl<'a> Scan<'a> {
    /// The innermost bracket; the text itself is never closed.
    fn top(&mut self) -> &mut Frame {
        let last = self.frames.len() - 1;
        &mut self.frames[last]
    }

    /// Whether the token was one of generic arguments, which end at the bracket that matches or at
    /// what they cannot hold.
    fn in_generic(&mut self, token: Token) -> bool {
        match token {
            Token::Mark(b'<') => self.generic += 1,
            Token::Mark(b'>') => self.generic -= 1,
            Token::Mark(b';' | b'=') | Token::Open(_) | Token::Close(_) => {
                self.generic = 0;
                return false;
            }
            _ => {}
        }
        true
    }

    fn token(&mut self, at: usize, token: Token<'a>) -> Result<(), ForeignError> {
        let word = self.word;
        if !matches!(token, Token::Mark(b'<' | b'>' | b'p' | b'.' | b'!')) {
            self.word = None;
        }
        match token {
            Token::Number(number) => self.number(at, number)?,
            Token::Word(name) => self.name(at, name, word)?,
            Token::Open(bracket) => self.open(at, bracket, word)?,
            Token::Close(bracket) => self.close(at, bracket)?,
            Token::Mark(mark) => self.mark(at, mark)?,
            Token::Text => self.spoil()?,
        }
        Ok(())
    }

    fn number(&mut self, at: usize, number: Number) -> Result<(), ForeignError> {
        let bare = self.frames.len() == 1;
        if !self.top().pure {
            return Ok(());
        }
        if !self.top().free && !bare {
            return self.spoil();
        }
        if self.values.len() >= limits::VALUES {
            return Err(self.too_large("numbers", self.values.len() as u128 + 1, limits::VALUES));
        }
        let top = self.top();
        let sign = if std::mem::take(&mut top.negative) { -1.0 } else { 1.0 };
        top.free = false;
        top.list.decimals = top.list.decimals.max(number.decimals);
        top.list.hex &= number.hex;
        top.entry(at, &[], false);
        self.values.push(sign * number.value);
        Ok(())
    }

    fn name(&mut self, at: usize, name: &'a str, before: Option<&'a str>) -> Result<(), ForeignError> {
        // `Vec2::new`, `Uint16Array.of`: the type is the word before.
        let method =
            matches!(self.last, Token::Mark(b'p' | b'.')) && matches!(name, "new" | "of" | "from" | "array");
        self.word = if method { before } else { Some(name) };
        if let Some(value) = not_finite(name) {
            return self.number(at, Number { value, decimals: Some(0), hex: false });
        }
        if !self.top().free || !(is_maker(name) || is_vector(name)) {
            self.spoil()?;
        }
        Ok(())
    }

    fn mark(&mut self, at: usize, mark: u8) -> Result<(), ForeignError> {
        let maker = match self.last {
            Token::Word(word) => is_maker(word) || is_vector(word),
            _ => false,
        };
        let top = self.top();
        match mark {
            b',' if top.pure && !top.free => top.free = true,
            b'-' | b'+' if top.pure && (top.free || top.bracket == b'0') => top.negative ^= mark == b'-',
            b'<' if maker => self.generic = 1,
            b'p' | b'.' | b'!' if maker => {}
            b'&' if top.free => {}
            _ => self.spoil()?,
        }
        if matches!(mark, b';' | b',') {
            self.top().statement = at + 1;
        }
        Ok(())
    }

    fn open(&mut self, at: usize, bracket: u8, word: Option<&str>) -> Result<(), ForeignError> {
        if self.frames.len() > limits::DEPTH {
            return Err(self.too_large("brackets nested", self.frames.len() as u128, limits::DEPTH));
        }
        // `float[4](...)`: the size of a type.
        let of_type = bracket == b'[' && word.is_some_and(|w| is_scalar_type(w) || is_vector(w));
        if !of_type && !self.top().free {
            self.spoil()?;
        }
        let mut frame = Frame::new(at, self.top().statement, bracket);
        frame.of_type = of_type;
        frame.vector = bracket != b'[' && word.is_some_and(is_vector);
        frame.first = self.values.len();
        self.frames.push(frame);
        Ok(())
    }

    fn close(&mut self, at: usize, bracket: u8) -> Result<(), ForeignError> {
        let Some(depth) = self.frames.iter().rposition(|f| f.closes_with(bracket)) else {
            return self.spoil();
        };
        if depth + 1 < self.frames.len() {
            self.spoil()?;
            self.frames.truncate(depth + 1);
        }
        let Some(frame) = self.frames.pop() else { return Ok(()) };
        if frame.of_type {
            self.values.truncate(frame.first);
            return Ok(());
        }
        let statement = if bracket == b'}' && !frame.pure { Some(at + 1) } else { None };
        if frame.pure {
            self.closed(frame, at)?;
        } else {
            self.spoil()?;
        }
        if let Some(statement) = statement {
            self.top().statement = statement;
        }
        Ok(())
    }

    /// A bracket of numbers is complete: an entry of the one around it, or a literal.
    fn closed(&mut self, frame: Frame, at: usize) -> Result<(), ForeignError> {
        if frame.list.shape.is_empty() {
            return self.spoil();
        }
        let end = self.values.len();
        let top = self.top();
        if top.pure {
            top.take(&frame, end, at);
            return Ok(());
        }
        if end - frame.first >= limits::ARRAY_MIN {
            self.keep(frame.literal(at + 1), frame.first, end)?;
        }
        self.values.clear();
        Ok(())
    }

    fn keep(&mut self, mut literal: Literal, first: usize, end: usize) -> Result<(), ForeignError> {
        if self.literals.len() >= LITERALS {
            return Err(self.too_large("arrays", LITERALS as u128 + 1, LITERALS));
        }
        literal.values = self.values[first..end].to_vec();
        self.literals.push(literal);
        Ok(())
    }

    /// Something that is no number: the open brackets are no literals, what is complete inside them
    /// is.
    fn spoil(&mut self) -> Result<(), ForeignError> {
        let first = self.frames.iter().position(|f| f.pure).unwrap_or(self.frames.len());
        for depth in first..self.frames.len() {
            self.frames[depth].pure = false;
            self.frames[depth].free = true;
            for (literal, first, end) in std::mem::take(&mut self.frames[depth].inside) {
                self.keep(literal, first, end)?;
            }
        }
        self.values.clear();
        Ok(())
    }

    /// The text ends: a list without brackets is a literal, a bracket of numbers that is still open
    /// is cut short.
    fn end(&mut self) -> Result<(), ForeignError> {
        let open = self.frames.len() - 1;
        let top = self.top();
        let (pure, at, first) = (top.pure, top.list.open, top.first);
        if open > 0 && pure && self.values.len() - first >= limits::ARRAY_MIN {
            let message = format!(
                "the bracket opened here is not closed, {} numbers follow: the file is cut short",
                self.values.len() - first
            );
            return Err(ForeignError::at(self.file, Spot::of(self.text, at), message));
        }
        if open == 0 && pure && self.values.len() >= limits::ARRAY_MIN {
            let end = self.text.len();
            let literal = self.top().literal(end);
            return self.keep(literal, 0, self.values.len());
        }
        self.spoil()
    }

    fn too_large(&self, what: &str, found: u128, limit: usize) -> ForeignError {
        ForeignError::too_large(self.file, what, found, limit)
    }
}
