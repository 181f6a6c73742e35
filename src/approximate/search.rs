//! The search of one hypothesis' coefficients in one norm.

use super::FitStageError;
use crate::data::{Formula, Norm};
use lobefit_fit::{Constraint, FitError, Options, Samples, Termination, optimise, round_to_f32};
use lobefit_shade::{Domain, Hypothesis, prove_regular};

/// What a search found: coefficients rounded to f32 and proven regular, under the name of their norm.
pub(crate) struct Searched {
    pub hypothesis: Hypothesis,
    pub coefficients: Vec<f32>,
    pub termination: Termination,
}

/// Coefficients for a hypothesis: found, rounded, proven regular.
pub(crate) fn searched(
    hypothesis: &Hypothesis,
    norm: Norm,
    samples: &Samples,
    domain: &Domain,
) -> Result<Searched, FitStageError> {
    searched_within(hypothesis, norm, (samples, &[]), domain, &Options::new(norm))
}

/// The same within constraints.
pub(crate) fn searched_within(
    hypothesis: &Hypothesis,
    norm: Norm,
    (samples, constraints): (&Samples, &[Constraint]),
    domain: &Domain,
    options: &Options,
) -> Result<Searched, FitStageError> {
    let fitted = optimise(hypothesis, samples, constraints, options);
    // Where the search cannot even start, the proof knows the place in the source that is at fault.
    let fitted = fitted.map_err(|error| {
        prove_regular(hypothesis.tape(), &hypothesis.starts(), domain).err().map_or(error, FitError::from)
    })?;
    if !fitted.termination.is_converged() {
        // A pole that the search ran into says more than how the search ended.
        prove_regular(hypothesis.tape(), &fitted.coefficients, domain)?;
        let (hypothesis, norm) = (hypothesis.file().to_string(), norm.name());
        return Err(FitStageError::NotConverged { hypothesis, norm, termination: fitted.termination });
    }
    refuse_run_away(hypothesis, norm, &fitted.coefficients)?;
    let coefficients = round_to_f32(&fitted.coefficients)?;
    let exact: Vec<f64> = coefficients.iter().map(|c| f64::from(*c)).collect();
    prove_regular(hypothesis.tape(), &exact, domain)?;
    Ok(Searched { hypothesis: named_for(hypothesis, norm), coefficients, termination: fitted.termination })
}

/// Coefficients above this (or a million times a starting value) are on their way to infinity: inputs lie in [0, 1].
const RUN_AWAY: f64 = 1e6;

fn refuse_run_away(hypothesis: &Hypothesis, norm: Norm, coefficients: &[f64]) -> Result<(), FitStageError> {
    let parameters = hypothesis.parameters().iter().zip(coefficients);
    let away = |start: f32, value: f64| value.abs() > RUN_AWAY * f64::from(start.abs()).max(1.0);
    match parameters.into_iter().find(|(p, value)| away(p.start, **value)) {
        None => Ok(()),
        Some((parameter, value)) => Err(FitStageError::RunAway {
            hypothesis: hypothesis.file().to_string(),
            norm: norm.name(),
            coefficient: parameter.name.clone(),
            value: *value,
        }),
    }
}

/// The minimax fit bears its hypothesis' name; the least squares fit has `_rms` appended, so that both can be emitted.
fn named_for(hypothesis: &Hypothesis, norm: Norm) -> Hypothesis {
    match norm {
        Norm::Max => hypothesis.clone(),
        Norm::Rms => hypothesis.renamed(&format!("{}_rms", hypothesis.name())),
    }
}

/// A formula with its coefficients.
pub fn formula(hypothesis: &Hypothesis, coefficients: &[f32], norm: &str) -> Formula {
    let names = hypothesis.parameters().iter().map(|p| p.name.clone());
    Formula {
        hypothesis: hypothesis.file().trim_end_matches(".wgsl").to_string(),
        inputs: hypothesis.inputs().to_vec(),
        coefficients: names.zip(coefficients.iter().copied()).collect(),
        norm: norm.to_string(),
    }
}
