//! The measured error of a fit in each arithmetic asked for.

use crate::approximate::target::{Sampled, Target};
use crate::data::{Certificate, Place};
use lobefit_shade::{Hypothesis, Measured, Precision, ShadeError, measure_in, round_up};

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
) -> Result<Certificate, ShadeError> {
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
        domain: target.ranges(),
        precision: precision.name().into(),
        points: all.points as u64,
    }
}
