//! Array literals of program texts: C, C++, HLSL, GLSL, WGSL, Rust, JavaScript, TypeScript, Python,
//! JSON, and lists of numbers without anything around them.
//!
//! Nested brackets are axes, outermost slowest; brackets of two to four numbers, and vectors, are
//! texels of channels. What is computed (`1.0 / 3.0`, `sin(x)`, `[0.5; 9]`) is no literal.

mod frame;
mod integers;
mod lead;
mod lex;
mod nesting;
mod scan;
mod words;

use frame::Literal;
use lead::Lead;
pub(super) use lex::{Lexer, Token};
pub(super) use nesting::nesting;

use super::shape::{self, Values};
use super::{ForeignError, ForeignTable, Hints, Spot, Step, error, limits};

/// The tables of a text: all, or the one that is asked for.
pub(super) fn read(bytes: &[u8], file: &str, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    let text = error::text(bytes, file, "text")?;
    let mut found: Vec<(Lead, Literal)> = scan::literals(text, file)?
        .into_iter()
        .map(|literal| (lead::lead(text, file, literal.statement, literal.open), literal))
        .collect();
    if found.is_empty() {
        let message = format!(
            "no array of at least {} numbers is written out in it; lists of computed values, and files that it includes, are \
             not read",
            limits::ARRAY_MIN
        );
        return Err(ForeignError::new(file, message));
    }
    if let Some(symbol) = &hints.symbol {
        let known: Vec<String> = found.iter().map(|(lead, _)| lead.name.clone()).collect();
        found.retain(|(lead, _)| lead.name == *symbol);
        if found.is_empty() {
            return Err(ForeignError::no_such(file, "array", symbol, &known));
        }
    }
    // Which of several is meant comes before what size one of them has.
    let counts =
        found.iter().map(|(lead, literal)| format!("{} ({} values)", lead.name, literal.values.len()));
    let several = (found.len() > 1).then(|| counts.collect::<Vec<_>>().join(", "));
    let read = found.into_iter().map(|(lead, literal)| table(text, file, lead, literal, hints));
    let read: Result<Vec<ForeignTable>, ForeignError> = read.collect();
    read.map_err(|error| match several {
        Some(names) => error.beside(&format!("the file has the arrays {names}: choose one by --symbol")),
        None => error,
    })
}

/// Whether a text has arrays that can be read.
pub fn holds_arrays(bytes: &[u8]) -> bool {
    let literals = std::str::from_utf8(bytes).ok().and_then(|text| scan::literals(text, "").ok());
    literals.is_some_and(|literals| !literals.is_empty())
}

fn table(
    text: &str,
    file: &str,
    lead: Lead,
    literal: Literal,
    hints: &Hints,
) -> Result<ForeignTable, ForeignError> {
    if let Some((at, message)) = literal.mixed {
        let message = match lead.name.as_str() {
            "" => message,
            name => format!("{name}: {message}"),
        };
        return Err(ForeignError::at(file, Spot::of(text, at), message));
    }
    let at = Spot::of(text, literal.open);
    let (size, channels) =
        dimensions(&lead, &literal).map_err(|message| ForeignError::at(file, at, message))?;
    let told = size.is_some() || hints.size.is_some();
    let lines = if told { None } else { lines(text, file, &literal) };
    let (kind, values, step) = if literal.decimals.is_none() {
        integers::read(file, at, &lead.name, literal.values, literal.hex, hints.format)?
    } else {
        let decimals = literal.decimals.unwrap_or(0);
        ("array of decimals".into(), literal.values, Step::Decimals(decimals))
    };
    let list = Values { name: lead.name, kind, values, size, channels, lines, step };
    shape::table(file, list, hints)
}

/// What the brackets or the declaration say.
fn dimensions(lead: &Lead, literal: &Literal) -> Result<shape::Grouped, String> {
    let declared = if lead.sizes.is_empty() {
        0
    } else {
        lead.sizes.iter().fold(1, |n: usize, &size| n.saturating_mul(size))
    };
    let nested: Vec<usize> = literal.shape.iter().copied().filter(|&n| n != 1).collect();
    let stated = &lead.sizes;
    if declared != 0 && !agree(stated, &literal.shape) {
        return Err(format!(
            "{} is declared as {} and holds {} numbers",
            lead.name,
            shape::words(stated),
            literal.values.len()
        ));
    }
    let flat = nested.len() < 2;
    let shape: &[usize] = if flat && declared == literal.values.len() { stated } else { &nested };
    if shape.len() < 2 {
        return Ok((None, None));
    }
    shape::grouped(shape, literal.vectors && !flat).map_err(|message| format!("{}: {message}", lead.name))
}

/// Whether declared sizes are those of the brackets, outermost first: channels may follow them, and
/// inner brackets may be left out.
fn agree(stated: &[usize], shape: &[usize]) -> bool {
    let long = |list: &[usize]| list.iter().copied().filter(|&n| n != 1).collect::<Vec<_>>();
    let (stated, shape) = (long(stated), long(shape));
    let same = stated.iter().zip(&shape).take_while(|(a, b)| a == b).count();
    let rest = stated[same..].iter().fold(1, |n: usize, &size| n.saturating_mul(size));
    same == stated.len() || shape[same..] == [rest]
}

/// Numbers on each line of a literal and its lines, if all lines hold as many.
fn lines(text: &str, file: &str, literal: &Literal) -> Option<(usize, usize)> {
    let part = &text[literal.open..literal.end];
    let mut lexer = Lexer::new(part, file);
    let (mut counts, mut last) = (Vec::new(), 0);
    while let Some((at, token)) = lexer.next() {
        if let Token::Number(_) = token {
            if counts.is_empty() || part[last..at].contains('\n') {
                counts.push(0);
            }
            last = at;
            if let Some(count) = counts.last_mut() {
                *count += 1;
            }
        }
    }
    let first = *counts.first()?;
    counts.iter().all(|&c| c == first).then_some((first, counts.len()))
}
