//! Coefficients for a formula: least squares from many starts, then the norm asked for.

mod affine;
mod bounds;
mod constrained;
mod constraint;
mod convex;
mod descent;
mod escape;
mod fitted;
mod global;
mod levenberg;
mod marquardt;
mod objective;
mod options;
mod power;
mod program;
mod rank;
mod recognise;
mod reduce;
mod route;
mod samples;
mod starts;
mod ties;

pub use constraint::{Condition, Constraint};
pub use fitted::{Fitted, Gap, Held, Method, SecondOrder, Stage, Termination};
pub use marquardt::{Halt, Least, Limits, Squares, least};
pub use options::{Goal, Norm, Options};
pub use reduce::Triangle;
pub use samples::Samples;

use crate::FitError;
use bounds::Bounds;
use constrained::worst;
use lobefit_shade::{Hypothesis, ShadeError};
use objective::{Objective, largest};
use power::PNorm;
use route::{Route, route};

/// Coefficients smaller than this become 0: shaders flush them anyway.
const TINY: f64 = 1e-30;

/// Fits the free parameters of a hypothesis to samples. Deterministic for any number of threads.
///
/// The search starts from the declared values and from points around them; coefficients at which a
/// residual is not finite, or a divisor changes sign among the samples, are never accepted. Whether
/// the formula has a pole between the samples is [`lobefit_shade::prove_regular`]'s to say.
///
/// # Errors
/// Data that are not finite or of the wrong shape, with the index; a p-norm's power out of range;
/// no start at which the formula is finite at every sample and its divisors keep their sign, with
/// what the declared one runs into and where; a constraint that no coefficients found obey.
pub fn optimise(
    hypothesis: &Hypothesis,
    samples: &Samples,
    constraints: &[Constraint],
    options: &Options,
) -> Result<Fitted, FitError> {
    options.goal.check()?;
    let tape = hypothesis.tape();
    constraints.iter().try_for_each(|c| c.check(tape))?;
    let objective = Objective::new(tape, samples)?;
    let points = bounds::points(constraints, tape.inputs().len());
    let unit = largest(&samples.scale);
    let unit = if unit > 0.0 { unit } else { 1.0 };
    let mut bounds = match constraints {
        [] => None,
        _ => Some(Bounds::new(constraints, tape, &points, unit)?),
    };
    let declared = hypothesis.starts();
    let found = if declared.is_empty() {
        Route::unmoved(declared, Termination::NoParameters)
    } else if samples.len() < declared.len() {
        Route::unmoved(declared, Termination::TooFewSamples)
    } else {
        let found = route(&objective, bounds.as_mut(), &declared, options)?;
        if options.goal == Goal::Max { ties::settled(&objective, bounds.as_ref(), found) } else { found }
    };
    finish(hypothesis, &objective, bounds.as_ref(), options, found)
}

fn finish(
    hypothesis: &Hypothesis,
    objective: &Objective,
    bounds: Option<&Bounds>,
    options: &Options,
    found: Route,
) -> Result<Fitted, FitError> {
    let goal = options.goal;
    let Route { coefficients, termination, second_order, stages, evaluations, gap, bound } = found;
    round_to_f32(&coefficients).map_err(|error| named(hypothesis, error))?;
    let linear = objective.linearise(&coefficients).map_err(|_| route::refused(objective, &coefficients))?;
    let (rms, max) = (PNorm::SQUARE.of(&linear.residuals), largest(&linear.residuals));
    let value = match goal {
        Goal::Max => max,
        Goal::Rms => rms,
        Goal::Power(p) => PNorm(p).of(&linear.residuals),
    };
    let names: Vec<String> = hypothesis.parameters().iter().map(|p| p.name.clone()).collect();
    let triangle = match bounds {
        // What only a constraint sees is determined by it.
        Some(bounds) => {
            let bounds =
                bounds.linearise(&coefficients).map_err(|_| route::refused(objective, &coefficients))?;
            program::joined(&linear, &bounds)
        }
        None => linear.triangle,
    };
    let steps = rank::in_steps(hypothesis.tape());
    let (rank, undetermined) = (triangle.rank(), rank::undetermined(&triangle, &names, &steps));
    let undetermined_everywhere = !undetermined.is_empty() && nowhere_full(hypothesis, objective, options);
    let evaluations = evaluations + 1;
    let constraints = bounds.map_or(Ok(Vec::new()), |bounds| -> Result<_, FitError> {
        let held = bounds.held(&coefficients)?;
        worst(&held).map_or(Ok(()), |i| Err(bounds.unsatisfiable(i, &held[i])))?;
        Ok(held)
    })?;
    Ok(Fitted {
        coefficients,
        termination,
        second_order,
        value,
        rms,
        max,
        evaluations,
        gap,
        bound,
        rank,
        undetermined,
        undetermined_everywhere,
        stages,
        constraints,
    })
}

/// Whether the samples determine fewer parameters than there are at every start that can be
/// evaluated.
fn nowhere_full(hypothesis: &Hypothesis, objective: &Objective, options: &Options) -> bool {
    let declared = hypothesis.starts();
    let mut starts = starts::starts(&declared, options.starts.max(STARTS), options.spread);
    starts.extend(starts::turned(hypothesis.tape(), &declared));
    let full =
        |start: &Vec<f64>| objective.linearise(start).is_ok_and(|l| l.triangle.rank() == declared.len());
    !starts.iter().any(full)
}

/// Starts at which the rank is looked at, at least: where a product is 0 a parameter in it does
/// nothing.
const STARTS: usize = 4;

/// Largest and root mean square residual of a formula at its starting coefficients; none where it
/// is not finite or a divisor changes sign among the samples.
///
/// # Errors
/// Data that are not finite or of the wrong shape, with the index.
pub fn residual_range(hypothesis: &Hypothesis, samples: &Samples) -> Result<Option<(f64, f64)>, FitError> {
    let objective = Objective::new(hypothesis.tape(), samples)?;
    Ok(objective.residuals(&hypothesis.starts()).ok().map(|r| (largest(&r), objective::rms(&r))))
}

/// The error of a coefficient by its parameter's name.
fn named(hypothesis: &Hypothesis, error: FitError) -> FitError {
    match error {
        FitError::Shade(ShadeError::NotFinite { index, value, .. }) => {
            let name = hypothesis.parameters().get(index).map_or("", |p| p.name.as_str());
            let column = format!("{}: coefficient `{name}` as f32", hypothesis.name());
            ShadeError::NotFinite { column, index, value }.into()
        }
        other => other,
    }
}

/// Coefficients rounded to f32, as they are emitted and certified; those below 1e-30 become 0.
///
/// # Errors
/// A coefficient that is not finite as f32, with its index.
pub fn round_to_f32(coefficients: &[f64]) -> Result<Vec<f32>, FitError> {
    let round = |(index, &value): (usize, &f64)| {
        let rounded = if value.abs() < TINY { 0.0 } else { value as f32 };
        if rounded.is_finite() {
            return Ok(rounded);
        }
        Err(ShadeError::NotFinite { column: "coefficient".to_string(), index, value }.into())
    };
    coefficients.iter().enumerate().map(round).collect()
}
