//! A formula with its coefficients, measured at points that it was not fitted on.

use super::place;
use super::target::{Sampled, Target};
use crate::data::{Approximation, Certificate, Cost, Form, Formula, Source};
use lobefit_shade::{Hypothesis, Precision, ShadeError, measure_in, round_up};

/// The error of a formula in one arithmetic.
///
/// # Errors
/// An input that the target does not have; a value that is not finite in this arithmetic.
pub fn certificate(
    hypothesis: &Hypothesis,
    coefficients: &[f32],
    target: &Target,
    measured: &Sampled,
    precision: Precision,
) -> Result<Certificate, ShadeError> {
    let inputs = measured.inputs(hypothesis.name(), hypothesis.inputs())?;
    let (scale, wanted, points) = (&measured.scale, &measured.target, &measured.points);
    let (all, uniform) =
        measure_in(hypothesis.tape(), coefficients, &inputs, scale, wanted, points.uniform, precision)?;
    Ok(Certificate {
        max_abs: round_up(all.max_abs, 4),
        max_rel: round_up(all.max_rel, 4),
        rms: uniform.rms,
        mean: uniform.mean,
        at: place(points, all.worst),
        domain: target.ranges(),
        precision: precision.name().into(),
        points: all.points as u64,
    })
}

/// A formula with its coefficients; `norm` is what they minimise.
pub fn formula(hypothesis: &Hypothesis, coefficients: &[f32], norm: &str) -> Formula {
    let names = hypothesis.parameters().iter().map(|p| p.name.clone());
    Formula {
        hypothesis: hypothesis.file().trim_end_matches(".wgsl").to_string(),
        inputs: hypothesis.inputs().to_vec(),
        coefficients: names.zip(coefficients.iter().copied()).collect(),
        norm: norm.to_string(),
        half: None,
    }
}

/// The one with the larger error, the first of equals.
pub fn worse(a: Certificate, b: Certificate) -> Certificate {
    if b.max_abs > a.max_abs { b } else { a }
}

/// A measured formula as an approximation of its target.
pub fn approximation(
    hypothesis: &Hypothesis,
    form: Formula,
    target: &Target,
    source: Source,
    certificate: Certificate,
) -> Approximation {
    Approximation {
        name: hypothesis.name().to_string(),
        quantity: target.quantity.name().into(),
        column: target.column.into(),
        used_as: target.used_as,
        smith: target.variant.smith,
        side: target.variant.side,
        source,
        form: Form::Formula(form),
        certificate,
        cost: Cost { ops: hypothesis.tape().cost_ops(), fetches: 0, bytes: 0 },
    }
}
