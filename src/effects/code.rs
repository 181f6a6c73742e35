//! Fits as functions in the include files.

use super::BakeError;
use crate::approximate::Fit;
use crate::data::Use;
use crate::emit::compensation::{coloured, coloured_ops};
use crate::emit::header;
use lobefit_shade::code::{self, CodeError, Language};
use lobefit_truth::quantity::Residual;

/// The emitted fits in a language, each with its header; normalisations with their form for three
/// channels where a material has a colour.
///
/// # Errors
/// A formula that cannot be printed.
pub fn functions(language: Language, fits: &[Fit], is_coloured: bool) -> Result<String, BakeError> {
    let mut text = String::new();
    for fit in fits.iter().filter(|f| f.emitted) {
        text += &function(language, fit, &lines(fit))?;
        if let Some(name) = rgb(fit, is_coloured) {
            let float = fit.hypothesis.float();
            let (own, colour) = (fit.approximation.cost.ops, coloured_ops().map_err(CodeError::from)?);
            let ops = format!(
                "{} operations, {own} for N and {colour} for the colour{}.",
                own + colour,
                beside(fit)
            );
            let header: Vec<String> = RGB.lines().map(String::from).chain([ops]).collect();
            let (inner, arguments) = (fit.hypothesis.name(), fit.hypothesis.arguments());
            text += &format!("\n{}", coloured(language, &name, &arguments, inner, float, &header)?);
        }
    }
    Ok(text)
}

const RGB: &str = "\
The energy compensation of a metal, 1 + f0 (N - 1) per colour channel: it gains colour as light scatters more than once.
The error of N at f0 = 1; relative to 1 + f0 (1/E - 1) no larger at any other f0.";

/// The name of a normalisation's form for three channels, where a material has a colour.
pub fn rgb(fit: &Fit, is_coloured: bool) -> Option<String> {
    let normalises = fit.approximation.used_as == Use::NORMALISATION;
    (normalises && is_coloured).then(|| format!("{}_rgb", fit.hypothesis.name()))
}

/// One fit below a header, and in half precision the function of two evaluations at once.
///
/// # Errors
/// A formula that cannot be printed.
pub fn function(language: Language, fit: &Fit, lines: &[String]) -> Result<String, BakeError> {
    let text = code::print(language, &fit.hypothesis, &fit.coefficients(), lines)?.text;
    let header = [format!("Two evaluations of {} at once, each within its error.", fit.hypothesis.name())];
    let pair = code::print_pair(language, &fit.hypothesis, &fit.coefficients(), &header)?;
    Ok(format!("\n{text}{}", pair.map_or_else(String::new, |pair| format!("\n{pair}"))))
}

/// The comment of the formula's file, with a line after it where there is any.
pub fn documented(fit: &Fit) -> Vec<String> {
    let mut lines: Vec<String> = fit.hypothesis.doc().to_vec();
    if !lines.is_empty() {
        lines.push(String::new());
    }
    lines
}

/// Where the constants of a fit come from.
pub fn constants(fit: &Fit) -> String {
    match fit.norm() {
        "published" => format!("constants as published: {}", fit.approximation.source.text()),
        _ if fit.coefficients().is_empty() => "no constants to fit".into(),
        "rms" => "constants minimise the RMS error".into(),
        _ => "constants minimise the largest error".into(),
    }
}

/// What a function does before its formula: `, and 1 more for alpha, which the lobe needs too`.
fn beside(fit: &Fit) -> String {
    let more = fit.hypothesis.tape().cost_ops().saturating_sub(fit.approximation.cost.ops);
    let is_given = fit.hypothesis.inputs().iter().any(|input| input == "alpha");
    match more {
        0 => String::new(),
        _ if is_given => format!(", and {more} more for roughness, which the material has"),
        _ => format!(", and {more} more for alpha, which the lobe needs too"),
    }
}

/// The header of one function: what it is, its error and its cost.
fn lines(fit: &Fit) -> Vec<String> {
    let a = &fit.approximation;
    let mut lines = documented(fit);
    let what = match a.used_as {
        Use::NORMALISATION => "furnace error |E N - 1|",
        Use::F0_BLEND => "of f0 A + B, at the worst f0",
        used_as if used_as.residual == Residual::Quotient => "relative",
        _ => "absolute",
    };
    let smith = a.smith.map_or_else(String::new, |smith| format!(", smith {}", smith.name()));
    let ops = [header::operations(a.cost.ops), beside(fit)].concat();
    lines.push(format!("{}: {} {}{smith}; {ops}; {}", a.name, a.quantity, a.column, constants(fit)));
    lines.extend(header::certificate_lines(what, &a.certificate));
    lines.extend(header::half_line(a));
    lines
}
