//! What was found, for people at a terminal.

use std::fmt::Write;

use super::catalogue::{beside, ways_out};
use super::{Certified, Fitting, FittingError, Job, Proof, printed, words};
use lobefit::emit::header::{operations, place, short};
use lobefit_shade::code::Language;

/// The fits in words, each with its code, and how to emit it unless it is `written`.
pub fn summary(job: &Job, fitting: &Fitting, written: bool) -> Result<String, FittingError> {
    let mut out = String::new();
    for fit in &fitting.fits {
        if !out.is_empty() {
            out.push('\n');
        }
        out += &of_fit(job, fitting, fit, written)?;
    }
    Ok(out)
}

fn of_fit(job: &Job, fitting: &Fitting, fit: &Certified, written: bool) -> Result<String, FittingError> {
    let (a, target) = (&fit.approximation, &fitting.target);
    let mut out = String::new();
    let mut line = |text: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{text}");
    };
    let smith = words::smith(target);
    let words: Vec<String> = target.words().iter().map(|(k, v)| format!(", {k} {v}")).collect();
    line(format!(
        "{}: {} {} as {}{}, alpha = {}{}",
        a.name,
        a.quantity,
        a.column,
        a.used_as.name,
        smith,
        target.alpha_map.name(),
        words.concat()
    ));
    let weight = words::weighted(job.weight.as_deref(), fit.goal);
    line(format!("  minimised    {}{weight}", words::minimised(fit.goal)));
    if let (Some(weight), Some(error)) = (&job.weight, &fit.weighted) {
        line(format!("  weighted     {}", words::weighted_error(weight, error)));
    }
    let converged = if fit.fitted.termination.is_converged() { "" } else { "NOT CONVERGED: " };
    line(format!("  ended        {converged}{}", words::end(&fit.fitted)));
    line(format!("  optimality   {}", words::optimality(&fit.fitted, job.weight.is_some())));
    for text in fit.fitted.undetermined.iter().chain(&fit.notes) {
        line(format!("  parameters   {text}"));
    }
    for kept in &fit.kept {
        line(format!("  constraint   {}", words::constraint(kept)));
    }
    match &fit.proof {
        Proof::Regular => line(
            "  regular      proven over the whole domain: divisors keep their sign, no root of a negative number, no overflow"
                .into(),
        ),
        Proof::NotProven(error) => line(format!("  regular      NOT PROVEN: {error}")),
    }
    line(format!("  cost         {}", operations(a.cost.ops)));
    let domain: Vec<String> =
        a.certificate.domain.iter().map(|(name, [low, high])| format!("{name} [{low}, {high}]")).collect();
    line(format!("  domain       {}", domain.join(", ")));
    line(format!(
        "  error        {}; at {} points, of which none in the interior took part in the fit",
        a.used_as.metric, a.certificate.points
    ));
    for (precision, certificate) in &fit.certificates {
        match certificate {
            Ok(c) => line(format!(
                "    {:<8}   max {} at {}; rms {}, mean {}",
                precision.name(),
                c.max_abs,
                place(&c.at),
                short(c.rms),
                short(c.mean)
            )),
            Err(error) => line(format!("    {:<8}   {error}", precision.name())),
        }
    }
    if let Some(text) = beside(&fitting.catalogue, a.cost.ops, a.certificate.max_abs) {
        line(format!("  catalogue    {text}"));
    }
    if !written {
        line(format!("  emit it      {}", ways_out(target)));
    }
    for (parameter, value) in fit.hypothesis.parameters().iter().zip(&fit.coefficients) {
        line(format!("  {:<12} {value}", parameter.name));
    }
    line(String::new());
    out += &printed::function(Language::Wgsl, job, fitting, fit)?;
    Ok(out)
}
