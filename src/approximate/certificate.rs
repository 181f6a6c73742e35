//! A formula with its coefficients, measured at points that it was not fitted on.

use super::place;
use super::target::{Sampled, Target};
use crate::data::{Approximation, Certificate, Cost, Form, Formula, HalfRefusal, Place, Source, shortest};
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

/// The error of a formula in half precision, by the worse of the two ways of rounding products, or
/// why it has none.
///
/// # Errors
/// An input that the target does not have.
pub fn half(
    hypothesis: &Hypothesis,
    coefficients: &[f32],
    target: &Target,
    measured: &Sampled,
) -> Result<Result<Certificate, HalfRefusal>, ShadeError> {
    let of = |precision| match certificate(hypothesis, coefficients, target, measured, precision) {
        Ok(certificate) => Ok(Ok(certificate)),
        Err(error) => refused(error).map(Err),
    };
    Ok(match [of(Precision::F16)?, of(Precision::F16Fused)?] {
        [Ok(apart), Ok(fused)] => Ok(worse(apart, fused)),
        [Err(refusal), _] | [_, Err(refusal)] => Err(refusal),
    })
}

/// The one with the larger error, the first of equals.
pub fn worse(a: Certificate, b: Certificate) -> Certificate {
    if b.max_abs > a.max_abs { b } else { a }
}

/// What an arithmetic without a finite value is refused for; other errors are handed on.
fn refused(error: ShadeError) -> Result<HalfRefusal, ShadeError> {
    let refused = error.to_string();
    match error {
        ShadeError::Unmeasurable { at, .. } => {
            let at = at.into_iter().map(|(name, x)| (name, shortest(x))).collect();
            Ok(HalfRefusal { refused, at })
        }
        ShadeError::Unrepresentable { .. } => Ok(HalfRefusal { refused, at: Place::new() }),
        other => Err(other),
    }
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
        source,
        form: Form::Formula(form),
        certificate,
        cost: Cost { ops: hypothesis.tape().cost_ops(), fetches: 0, bytes: 0 },
    }
}
