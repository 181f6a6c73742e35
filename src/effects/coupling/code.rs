//! The section of this effect in the include files: under each kind of lobe its factors, the exact
//! one from E and B, and a material.

use super::bake::Lobe;
use super::rule;
use crate::approximate::Fit;
use crate::effects::BakeError;
use crate::effects::code::{constants, documented, function};
use crate::effects::coupling::AnyF0;
use crate::effects::coupling::emitted as coupling;
use crate::emit::header;
use lobefit_shade::code::{Float, Language};
use lobefit_truth::quantity::Specular;

/// The text of a lobe; empty where nothing is emitted.
pub fn in_language(language: Language, lobe: &Lobe) -> Result<String, BakeError> {
    let mut text = String::new();
    for (fit, any) in lobe.measured().filter(|(fit, _)| fit.emitted) {
        text += &function(language, fit, &lines(lobe, fit, any))?;
    }
    let specular = lobe.spec.specular;
    if let Some(best) = lobe.best() {
        text += &format!("\n{}", coupling::exact(language, specular)?);
        let (name, inputs, float) =
            (best.hypothesis.name(), best.hypothesis.inputs(), best.hypothesis.float());
        text += &format!("\n{}", coupling::coupled(language, specular, name, inputs, float)?);
        // Its average is measured in f32; path tracers compute in no less.
        if specular == Specular::Single && float == Float::F32 {
            let error = rule::error(&lobe.spec.region, lobe.spec.f0, best)?;
            text += &format!("\n{}", coupling::reciprocal(language, name, inputs, error)?);
        }
    }
    Ok(text)
}

/// The header of a factor: what it is, its error and its cost.
fn lines(lobe: &Lobe, fit: &Fit, any: &AnyF0) -> Vec<String> {
    let a = &fit.approximation;
    let mut lines = documented(fit);
    let (smith, ops) = (lobe.spec.smith.name(), header::operations(a.cost.ops));
    lines.push(format!(
        "{}: {} {}, specular {}, smith {smith}; {ops}; {}",
        a.name,
        a.quantity,
        a.column,
        lobe.spec.specular.name(),
        constants(fit)
    ));
    lines.extend(header::certificate_lines(
        "of the factor: of the furnace, the lobe exact and the base white",
        &a.certificate,
    ));
    lines.extend(header::half_line(a));
    lines.push(format!(
        "over f0 in [0, 1], in f32: max {}, the largest found at {} places of roughness and mu for {}",
        any.max,
        any.places,
        any.f0.words()
    ));
    lines.push(format!("  worst at {}", header::place(&any.at)));
    if let Some(safe) = &fit.safe {
        let ranges: Vec<String> =
            safe.iter().map(|(name, [low, high])| format!("{name} [{low}, {high}]")).collect();
        lines.push(format!(
            "proven, rounding in f32 included: no pole and no value below 0 for {}",
            ranges.join(", ")
        ));
    }
    lines
}
