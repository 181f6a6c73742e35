//! Fits as functions in the include files.

use super::BakeError;
use crate::approximate::Fit;
use crate::data::Use;
use crate::emit::compensation::saturating;
use crate::emit::header;
use lobefit_shade::code::{self, Language};

/// The emitted fits in a language, each with its header.
///
/// # Errors
/// A formula that cannot be printed.
pub fn functions(language: Language, fits: &[Fit]) -> Result<String, BakeError> {
    let mut text = String::new();
    for fit in fits.iter().filter(|f| f.emitted) {
        text += &function(language, fit, &lines(fit))?;
    }
    Ok(text)
}

/// One fit below a header.
///
/// # Errors
/// A formula that cannot be printed.
pub fn function(language: Language, fit: &Fit, lines: &[String]) -> Result<String, BakeError> {
    let text = match &fit.wraps {
        Some(inner) => saturating(language, &fit.approximation.name, fit.hypothesis.inputs(), inner, lines)?,
        None => code::print(language, &fit.hypothesis, &fit.coefficients(), lines)?.text,
    };
    Ok(format!("\n{text}"))
}

/// The comment of the formula's file, with a line after it where there is any.
pub fn documented(fit: &Fit) -> Vec<String> {
    let mut lines: Vec<String> = fit.hypothesis.doc().to_vec();
    if !lines.is_empty() {
        lines.push(String::new());
    }
    lines
}

/// The header of one function: what it is, its error and its cost.
fn lines(fit: &Fit) -> Vec<String> {
    let a = &fit.approximation;
    let mut lines = documented(fit);
    let what = match (&fit.wraps, a.used_as) {
        (Some(_), _) => {
            "furnace error |E N - 1| at f0 = 1; no larger, relative to 1 + f0 (1/E - 1), at any other f0"
        }
        (None, Use::NORMALISATION) => "furnace error |E N - 1|",
        (None, Use::F0_BLEND) => "of f0 A + B, at the worst f0",
        (None, _) => "absolute",
    };
    let constants = match fit.norm() {
        "published" => format!("as published: {}", a.source.text()),
        norm => format!("fitted for the smallest {norm} error"),
    };
    let smith = a.smith.map_or_else(String::new, |smith| format!(", smith {}", smith.name()));
    let ops = header::operations(a.cost.ops);
    lines.push(format!("{} {}{smith}; {ops}; constants {constants}", a.quantity, a.column));
    lines.extend(header::certificate_lines(what, &a.certificate));
    lines
}
