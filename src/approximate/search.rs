//! The search of one hypothesis' coefficients in one norm.

use super::{FitStageError, Runaway};
use crate::data::Norm;
use lobefit_fit::{Constraint, FitError, Gap, Goal, Options, Samples, optimise, round_to_f32};
use lobefit_shade::{Domain, Hypothesis, prove_regular};

/// Coefficients for a hypothesis within constraints: found, rounded, proven regular. They are a minimum,
/// or less than the part `near` of the error is left to gain.
pub(crate) fn searched(
    hypothesis: &Hypothesis,
    norm: Norm,
    (samples, constraints): (&Samples, &[Constraint]),
    domain: &Domain,
    (options, near): (&Options, f64),
) -> Result<Vec<f32>, FitStageError> {
    let fitted = optimise(hypothesis, samples, constraints, options);
    // Where the search cannot even start, the proof knows the place in the source that is at fault.
    let fitted = fitted.map_err(|error| {
        prove_regular(hypothesis.tape(), &hypothesis.starts(), domain).err().map_or(error, FitError::from)
    })?;
    let is_near = matches!(fitted.gap, Gap::Local(gap) | Gap::Global(gap) if gap < near);
    if !fitted.termination.is_converged() && !is_near {
        // A pole that the search ran into says more than how the search ended.
        prove_regular(hypothesis.tape(), &fitted.coefficients, domain)?;
        let (hypothesis, norm) = (hypothesis.file().to_string(), norm.name());
        return Err(FitStageError::NotConverged { hypothesis, norm, termination: fitted.termination });
    }
    if let Some(runaway) = runaways(hypothesis, &fitted.coefficients).next() {
        let (hypothesis, norm) = (hypothesis.file().to_string(), norm.name());
        return Err(FitStageError::RunAway { hypothesis, norm, runaway });
    }
    let coefficients = round_to_f32(&fitted.coefficients)?;
    let exact: Vec<f64> = coefficients.iter().map(|c| f64::from(*c)).collect();
    prove_regular(hypothesis.tape(), &exact, domain)?;
    Ok(coefficients)
}

/// Coefficients above this (or a million times a starting value) are on their way to infinity:
/// inputs lie in [0, 1] or not far from it.
const RUN_AWAY: f64 = 1e6;

/// The coefficients of a formula that are on their way to infinity.
pub fn runaways(hypothesis: &Hypothesis, coefficients: &[f64]) -> impl Iterator<Item = Runaway> {
    let parameters = hypothesis.parameters().iter().zip(coefficients);
    let away = |start: f32, value: f64| value.abs() > RUN_AWAY * f64::from(start.abs()).max(1.0);
    let away = parameters.filter(move |(p, value)| away(p.start, **value));
    away.map(|(p, value)| Runaway { coefficient: p.name.clone(), value: *value })
}

/// The minimax fit bears its hypothesis' name; a fit in another norm has its norm appended, so that
/// all can be emitted.
pub fn named_for(hypothesis: &Hypothesis, goal: Goal) -> Hypothesis {
    let name = hypothesis.name();
    match goal {
        Goal::Max => hypothesis.clone(),
        Goal::Rms => hypothesis.renamed(&format!("{name}_rms")),
        Goal::Power(p) => hypothesis.renamed(&format!("{name}_p{}", p.to_string().replace('.', "_"))),
    }
}
