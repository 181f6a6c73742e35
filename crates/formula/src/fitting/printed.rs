//! The emitted code of fits, by language.

use super::{Certified, Fitting, FittingError, Job, words};
use lobefit::data::Certificate;
use lobefit::emit::header::{self, Recipe};
use lobefit_shade::Hypothesis;
use lobefit_shade::code::{self, Language};
use lobefit_shade::comment::comment;

/// Refuses a formula whose name a language has taken, before anything is computed.
pub(super) fn check(language: Language, hypothesis: &Hypothesis) -> Result<(), FittingError> {
    let starts: Vec<f32> = hypothesis.parameters().iter().map(|p| p.start).collect();
    match code::print(language, hypothesis, &starts, &[]) {
        // Starts are not what is printed: a tiny or endless one is no fault.
        Err(source @ code::CodeError::Name { .. }) => {
            Err(FittingError::Code { file: hypothesis.file().into(), source })
        }
        _ => Ok(()),
    }
}

/// The file of a language: a header and every fit.
pub(super) fn file(
    language: Language,
    job: &Job,
    fitting: &Fitting,
    recipe: &Recipe,
) -> Result<String, FittingError> {
    let mut text = comment(language.comment(), &recipe.lines());
    let opening = language.opening();
    if !opening.is_empty() {
        text += &format!("\n{opening}");
    }
    for fit in &fitting.fits {
        text += &format!("\n{}", function(language, job, fitting, fit)?);
    }
    Ok(text)
}

/// A fit's function with what it is as its documentation.
pub(super) fn function(
    language: Language,
    job: &Job,
    fitting: &Fitting,
    fit: &Certified,
) -> Result<String, FittingError> {
    let lines = lines(job, fitting, fit);
    let printed = code::print(language, &fit.hypothesis, &fit.coefficients, &lines);
    let printed =
        printed.map_err(|source| FittingError::Code { file: fit.hypothesis.file().into(), source })?;
    Ok(printed.text)
}

fn lines(job: &Job, fitting: &Fitting, fit: &Certified) -> Vec<String> {
    let (a, target) = (&fit.approximation, &fitting.target);
    let mut lines: Vec<String> = fit.hypothesis.doc().to_vec();
    if !lines.is_empty() {
        lines.push(String::new());
    }
    lines.push(format!(
        "{} {} as {}{}, alpha = {}; {}",
        a.quantity,
        a.column,
        a.used_as.name,
        words::smith(target),
        target.alpha_map.name(),
        header::operations(a.cost.ops)
    ));
    lines.extend(target.words().iter().map(|(input, word)| format!("{input}: {word}")));
    let weight = job.weight.as_ref().map_or(String::new(), |weight| format!(", weighted by {weight}"));
    if !fit.hypothesis.parameters().is_empty() {
        lines.push(format!("constants found by minimising {}{weight}", words::minimised(fit.goal)));
    }
    let demands: Vec<String> = job.demands.iter().map(super::Demand::words).collect();
    if !demands.is_empty() {
        lines.push(format!("constraints: {}", demands.join("; ")));
    }
    lines.extend(header::certificate_lines(a.used_as.metric, &a.certificate));
    lines.extend(fit.certificates.iter().skip(1).filter_map(|(_, c)| Some(short(c.as_ref().ok()?))));
    lines
}

/// A further certificate in one line.
fn short(certificate: &Certificate) -> String {
    let Certificate { precision, max_abs, rms, .. } = certificate;
    format!("  in {precision}: max {max_abs}, rms {}", header::short(*rms))
}
