//! The measured error of a fit in each arithmetic asked for.

use std::collections::BTreeMap;

use crate::data::{Certificate, Place};
use crate::effects::target::{Sampled, Target};
use crate::fit::{FitError, Hypothesis, Measured, Precision, measure_in, round_up};

/// A certificate in one arithmetic, at points that the formula was not fitted on.
///
/// # Errors
/// A value that is not finite in this arithmetic.
pub(super) fn certificate(
    hypothesis: &Hypothesis,
    coefficients: &[f32],
    target: &Target,
    measured: &Sampled,
    precision: Precision,
) -> Result<Certificate, FitError> {
    let inputs = measured.inputs(hypothesis.name(), hypothesis.inputs())?;
    let (all, uniform) = measure_in(
        hypothesis.tape(),
        coefficients,
        &inputs,
        &measured.scale,
        &measured.target,
        measured.points.uniform,
        precision,
    )?;
    Ok(stated(&all, &uniform, measured.points.place(all.worst), target, precision))
}

fn stated(
    all: &Measured,
    uniform: &Measured,
    at: Place,
    target: &Target,
    precision: Precision,
) -> Certificate {
    Certificate {
        max_abs: round_up(all.max_abs, 4),
        max_rel: round_up(all.max_rel, 4),
        rms: uniform.rms,
        mean: uniform.mean,
        at,
        domain: domain(target),
        precision: precision.name().into(),
        points: all.points as u64,
    }
}

/// Range of every input; alpha's to nine digits, since 0.1 squared is 0.01.
pub(super) fn domain(target: &Target) -> BTreeMap<String, [f64; 2]> {
    let nine = |x: f64| format!("{x:.8e}").parse().unwrap_or(x);
    let mut domain: BTreeMap<String, [f64; 2]> =
        target.spans().into_iter().map(|span| (span.name, span.range)).collect();
    if let Some(roughness) = domain.get("roughness").copied()
        && target.has_alpha()
    {
        domain.insert("alpha".into(), roughness.map(|r| nine(target.alpha_map.alpha(r))));
    }
    domain
}
