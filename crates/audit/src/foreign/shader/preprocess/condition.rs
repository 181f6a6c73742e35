//! The condition of an `#if`: integers, as in C; a name that is no macro is 0.

use super::Bad;
use super::lex::{Kind, Token};
use super::macros::Macros;
use crate::foreign::limits;
use crate::foreign::shader::text::Origin;

/// Whether a condition holds.
pub(super) fn holds(line: &[Token], macros: &mut Macros, at: Origin) -> Result<bool, Bad> {
    let plain = macros.expand(without_defined(line, macros))?;
    let words: Vec<&str> = plain.iter().filter(|t| t.kind != Kind::Blank).map(|t| t.text.as_str()).collect();
    let mut reader = Reader { words: &words, at: 0, depth: 0 };
    let value = reader.binary(0).filter(|_| reader.at == words.len());
    let message = || format!("the condition `{}` is no arithmetic of whole numbers", words.join(" "));
    Ok(value.ok_or_else(|| Bad { from: at, message: message() })? != 0)
}

/// The tokens with 1 or 0 for `defined NAME` and `defined(NAME)`.
fn without_defined(line: &[Token], macros: &Macros) -> Vec<Token> {
    let solid: Vec<&Token> = line.iter().filter(|t| t.kind != Kind::Blank).collect();
    let mut out = Vec::new();
    let mut k = 0;
    while let Some(token) = solid.get(k) {
        let bracket = solid.get(k + 1).is_some_and(|t| t.is("("));
        let name = solid.get(k + 1 + usize::from(bracket)).filter(|t| t.kind == Kind::Name);
        match name {
            Some(name) if token.is("defined") => {
                let text = if macros.known.contains_key(&name.text) { "1" } else { "0" };
                out.push(Token { kind: Kind::Number, text: text.into(), ..(*token).clone() });
                k += if bracket { 4 } else { 2 };
            }
            _ => {
                out.push((*token).clone());
                k += 1;
            }
        }
    }
    out
}

/// Operators of two operands, the weakest first; longer ones before those that they begin with.
const LEVELS: [&[&str]; 10] = [
    &["||"],
    &["&&"],
    &["|"],
    &["^"],
    &["&"],
    &["==", "!="],
    &["<=", ">=", "<", ">"],
    &["<<", ">>"],
    &["+", "-"],
    &["*", "/", "%"],
];

struct Reader<'a> {
    words: &'a [&'a str],
    at: usize,
    depth: usize,
}

impl Reader<'_> {
    /// The operator of a level that stands here, characters of one operator being words of their
    /// own.
    fn operator(&self, level: usize) -> Option<&'static str> {
        let here = |op: &str| {
            op.chars()
                .enumerate()
                .all(|(k, c)| self.words.get(self.at + k).is_some_and(|w| w.chars().eq([c])))
        };
        // `<` of `<<` and `&` of `&&` are of another level.
        let longer = |op: &str| {
            LEVELS
                .iter()
                .flat_map(|list| list.iter())
                .any(|o| o.len() > op.len() && o.starts_with(op) && here(o))
        };
        LEVELS[level].iter().copied().find(|op| here(op) && !longer(op))
    }

    fn binary(&mut self, level: usize) -> Option<i64> {
        if level == LEVELS.len() {
            return self.unary();
        }
        let mut left = self.binary(level + 1)?;
        while let Some(op) = self.operator(level) {
            self.at += op.len();
            let right = self.binary(level + 1)?;
            let truth = |holds: bool| Some(i64::from(holds));
            left = match op {
                "||" => truth(left != 0 || right != 0),
                "&&" => truth(left != 0 && right != 0),
                "==" => truth(left == right),
                "!=" => truth(left != right),
                "<=" => truth(left <= right),
                ">=" => truth(left >= right),
                "<" => truth(left < right),
                ">" => truth(left > right),
                "|" => Some(left | right),
                "^" => Some(left ^ right),
                "&" => Some(left & right),
                "<<" => u32::try_from(right).ok().and_then(|n| left.checked_shl(n)),
                ">>" => u32::try_from(right).ok().and_then(|n| left.checked_shr(n)),
                "+" => left.checked_add(right),
                "-" => left.checked_sub(right),
                "*" => left.checked_mul(right),
                "/" => left.checked_div(right),
                _ => left.checked_rem(right),
            }?;
        }
        Some(left)
    }

    fn unary(&mut self) -> Option<i64> {
        self.depth += 1;
        let word = *self.words.get(self.at).filter(|_| self.depth < limits::NESTING)?;
        self.at += 1;
        let value = match word {
            "!" => i64::from(self.unary()? == 0),
            "-" => self.unary()?.checked_neg()?,
            "+" => self.unary()?,
            "~" => !self.unary()?,
            "(" => {
                let value = self.binary(0)?;
                self.words.get(self.at).filter(|w| **w == ")")?;
                self.at += 1;
                value
            }
            "true" => 1,
            _ if word.starts_with(|c: char| c.is_ascii_digit()) => integer(word)?,
            _ if word.starts_with(|c: char| c.is_alphabetic() || c == '_') => {
                // A call is none of ours.
                if self.words.get(self.at) == Some(&"(") {
                    return None;
                }
                0
            }
            _ => return None,
        };
        self.depth -= 1;
        Some(value)
    }
}

fn integer(word: &str) -> Option<i64> {
    let word = word.trim_end_matches(['u', 'U', 'l', 'L']);
    match word.strip_prefix("0x").or_else(|| word.strip_prefix("0X")) {
        Some(hex) => i64::from_str_radix(hex, 16).ok(),
        None => word.parse().ok(),
    }
}
