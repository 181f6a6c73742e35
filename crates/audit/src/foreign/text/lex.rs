//! Tokens of program text: what C, C++, HLSL, GLSL, WGSL, Rust, JavaScript and Python have in
//! common.

/// A piece of program text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::foreign) enum Token<'a> {
    /// A number, without its sign.
    Number(Number),
    /// A name or keyword.
    Word(&'a str),
    /// `( [ {`
    Open(u8),
    /// `) ] }`
    Close(u8),
    /// Any other character outside strings and comments; `::` is one, b'p'.
    Mark(u8),
    /// A string or character literal.
    Text,
}

/// A number as printed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::foreign) struct Number {
    /// Its value.
    pub value: f64,
    /// Digits after the decimal point, the exponent counted in; none for integers.
    pub decimals: Option<u32>,
    /// Written as `0x..`.
    pub hex: bool,
}

/// Tokens with the bytes where they begin and end.
pub(in crate::foreign) struct Lexer<'a> {
    text: &'a str,
    at: usize,
    /// `#` begins a comment (Python), a directive (C) or an attribute (Rust); all end with the
    /// line, but for `#[`. Single quotes enclose strings, rather than naming lifetimes.
    quotes: bool,
}

impl<'a> Lexer<'a> {
    pub fn new(text: &'a str, file: &str) -> Lexer<'a> {
        Lexer { text, at: 0, quotes: !file.ends_with(".rs") }
    }

    /// The next token.
    pub fn next(&mut self) -> Option<(usize, Token<'a>)> {
        self.skip();
        let start = self.at;
        let rest = &self.text[start..];
        let first = rest.chars().next()?;
        let length = |rest: &str, keep: fn(char) -> bool| rest.find(|c| !keep(c)).unwrap_or(rest.len());
        let next = rest.as_bytes().get(1).copied();
        let token = match first {
            '0'..='9' => self.number(),
            '.' if next.is_some_and(|c| c.is_ascii_digit()) => self.number(),
            c if c.is_alphabetic() || c == '_' || c == '$' => {
                let end = length(rest, |c| c.is_alphanumeric() || c == '_' || c == '$');
                self.at += end;
                Token::Word(&rest[..end])
            }
            '"' | '`' => self.string(first),
            '\'' if self.quotes => self.string(first),
            '(' | '[' | '{' => self.one(Token::Open(first as u8)),
            ')' | ']' | '}' => self.one(Token::Close(first as u8)),
            ':' if next == Some(b':') => {
                self.at += 2;
                Token::Mark(b'p')
            }
            c => {
                self.at += c.len_utf8();
                Token::Mark(if c.is_ascii() { c as u8 } else { b'?' })
            }
        };
        Some((start, token))
    }

    fn one(&mut self, token: Token<'a>) -> Token<'a> {
        self.at += 1;
        token
    }

    /// Blanks, comments, directives.
    fn skip(&mut self) {
        loop {
            let rest = &self.text[self.at..];
            let blank = rest.len() - rest.trim_start().len();
            self.at += blank;
            let rest = &rest[blank..];
            if rest.starts_with("//") {
                self.at += rest.find('\n').unwrap_or(rest.len());
            } else if rest.starts_with("/*") {
                self.at += rest.find("*/").map_or(rest.len(), |end| end + 2);
            } else if rest.starts_with('#') && !rest.starts_with("#[") && !rest.starts_with("#!") {
                self.at += directive(rest);
            } else if rest.starts_with('#') {
                self.at += 1;
            } else if blank == 0 || rest.is_empty() {
                return;
            }
        }
    }

    /// A string: to its closing quote, or to the end of the line if it is not closed there
    /// (backquotes reach over lines).
    fn string(&mut self, quote: char) -> Token<'a> {
        let rest = &self.text[self.at + 1..];
        let mut escaped = false;
        for (i, c) in rest.char_indices() {
            if !escaped && c == quote || c == '\n' && quote != '`' {
                self.at += i + 2;
                return Token::Text;
            }
            escaped = !escaped && c == '\\';
        }
        self.at = self.text.len();
        Token::Text
    }

    fn number(&mut self) -> Token<'a> {
        let rest = &self.text[self.at..];
        let (number, length) =
            if rest.starts_with("0x") || rest.starts_with("0X") { hexadecimal(rest) } else { decimal(rest) };
        self.at += length;
        match number {
            Some(number) => Token::Number(number),
            // What begins like a number and is none spoils the brackets around it, as any odd
            // character does.
            None => Token::Mark(b'?'),
        }
    }
}

/// Length of a directive, lines that end in a backslash joined.
fn directive(rest: &str) -> usize {
    let mut end = 0;
    for line in rest.split_inclusive('\n') {
        end += line.len();
        if !line.trim_end().ends_with('\\') {
            break;
        }
    }
    end
}

fn hexadecimal(rest: &str) -> (Option<Number>, usize) {
    let word = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '.').unwrap_or(rest.len());
    let digits: String = rest[2..word].chars().filter(|c| *c != '_').collect();
    let digits = digits.trim_end_matches(['u', 'U', 'l', 'L', 'n']);
    let digits = digits.strip_suffix("u16").or_else(|| digits.strip_suffix("u32")).unwrap_or(digits);
    let value = u64::from_str_radix(digits, 16).ok();
    (value.map(|v| Number { value: v as f64, decimals: None, hex: true }), word)
}

/// Suffixes of numbers, the longest of those that share an end first.
const SUFFIXES: [&str; 15] =
    ["f32", "f64", "f16", "u32", "u16", "u8", "i32", "lf", "LF", "hf", "ul", "UL", "f", "F", "h"];

fn decimal(rest: &str) -> (Option<Number>, usize) {
    let bytes = rest.as_bytes();
    let digit = |i: usize| bytes.get(i).is_some_and(|c| c.is_ascii_digit() || *c == b'_');
    let run = |mut i: usize| {
        while digit(i) {
            i += 1;
        }
        i
    };
    let whole = run(0);
    let fraction = if bytes.get(whole) == Some(&b'.') { run(whole + 1) } else { whole };
    let mut mantissa = fraction;
    if matches!(bytes.get(fraction), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(fraction + 1), Some(b'+' | b'-')));
        if digit(fraction + 1 + sign) {
            mantissa = run(fraction + 1 + sign);
        }
    }
    let suffix = &rest[mantissa..];
    let word = suffix.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(suffix.len());
    let known = suffix[..word].trim_start_matches('_');
    let plain = matches!(known, "" | "u" | "U" | "l" | "L" | "n" | "H" | "d" | "D");
    let text: String = rest[..mantissa].chars().filter(|c| *c != '_').collect();
    let value = if plain || SUFFIXES.contains(&known) { text.parse::<f64>().ok() } else { None };
    let exponent: i64 = text.split_once(['e', 'E']).and_then(|(_, e)| e.parse().ok()).unwrap_or(0);
    let digits = bytes[whole..fraction].iter().filter(|c| c.is_ascii_digit()).count();
    let printed = digits as i64 - exponent;
    let integer =
        fraction == whole && mantissa == fraction && !known.starts_with(['f', 'F', 'h', 'H', 'l', 'L']);
    let decimals = (!integer).then(|| printed.clamp(0, 400) as u32);
    (value.map(|value| Number { value, decimals, hex: false }), mantissa + word)
}
