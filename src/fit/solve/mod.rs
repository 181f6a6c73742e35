//! Coefficients for a formula: least squares from many starts, then, where the largest error counts, minimax.

mod chebyshev;
mod levenberg;
mod minimax;
mod objective;
mod reduce;
mod samples;
mod starts;

pub use crate::data::Norm;
pub use samples::Samples;

use rayon::prelude::*;

use super::{FitError, Hypothesis};
use levenberg::{End, Search, search};
use minimax::descend;
use objective::{Objective, largest, rms};

/// Samples that the first search from each start sees; the best then see all.
const COARSE: usize = 1536;

/// Starts whose search is carried on with all samples.
const FINALISTS: usize = 3;

/// Coefficients smaller than this become 0: shaders flush them anyway.
const TINY: f64 = 1e-30;

/// How to search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// What to minimise.
    pub norm: Norm,
    /// Number of starting points, the declared one included.
    pub starts: usize,
    /// Half width of the box of starting points: this part of each start's magnitude, or of 1 if that is larger.
    pub spread: f64,
    /// Iterations of each search.
    pub iterations: u64,
}

impl Options {
    /// 8 starts within half the magnitude of the declared one, 200 iterations.
    pub fn new(norm: Norm) -> Options {
        Options { norm, starts: 8, spread: 0.5, iterations: 200 }
    }
}

/// How a fit has ended. Only the first five are fits that can be relied on.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Termination {
    /// Least squares: the residuals are orthogonal to the Jacobian within this cosine.
    Converged {
        /// Largest cosine between the residuals and a column of the Jacobian.
        cosine: f64,
    },
    /// Minimax: the linear programs found nothing more to gain.
    Minimax,
    /// The formula reproduces the targets.
    ZeroResidual,
    /// The formula has no free parameters: there was nothing to fit.
    NoParameters,
    /// A minimum, but some coefficients are undetermined: the formula has more parameters than it needs.
    RankDeficient {
        /// Number of determined combinations of parameters.
        rank: usize,
    },
    /// Iterations used up.
    IterationCap,
    /// No step made progress, short of a minimum.
    Stalled,
    /// Fewer samples than parameters: the coefficients are the starting values.
    TooFewSamples,
}

impl Termination {
    /// Whether the coefficients are a minimum of the norm asked for.
    pub fn is_converged(self) -> bool {
        !matches!(self, Termination::IterationCap | Termination::Stalled | Termination::TooFewSamples)
    }
}

/// Coefficients found for a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// In the order of the parameters.
    pub coefficients: Vec<f64>,
    /// How the search ended.
    pub termination: Termination,
    /// Root of the mean square residual over the samples.
    pub rms: f64,
    /// Largest residual over the samples.
    pub max: f64,
    /// Evaluations of all samples (values or derivatives), over all starts.
    pub evaluations: u64,
    /// Minimax: the part of `max` that the last linear program could still have gained; infinite if the trust
    /// region held every step back. Least squares: 0.
    pub gap: f64,
}

/// Fits the free parameters of a hypothesis to samples. Deterministic for any number of threads.
///
/// The search starts from the declared values and from points around them; coefficients at which a residual is not
/// finite, or a divisor changes sign among the samples, are never accepted. Whether the formula has a pole between
/// the samples is [`super::prove_regular`]'s to say.
///
/// # Errors
/// Data that are not finite or of the wrong shape, with the index; no start at which the formula is finite at every
/// sample and its divisors keep their sign, with the sample that refused the declared one.
pub fn optimise(hypothesis: &Hypothesis, samples: &Samples, options: &Options) -> Result<Fitted, FitError> {
    let objective = Objective::new(hypothesis.tape(), samples)?;
    let declared = hypothesis.starts();
    if declared.is_empty() || samples.len() < declared.len() {
        let termination =
            if declared.is_empty() { Termination::NoParameters } else { Termination::TooFewSamples };
        return finish(&objective, declared, termination, 1, 0.0);
    }
    let searches = searches(&objective, &declared, options)?;
    match options.norm {
        Norm::Rms => {
            let evaluations = searches.iter().map(|s| s.evaluations).sum();
            // `searches` is sorted and not empty.
            let best = &searches[0];
            finish(
                &objective,
                best.coefficients.clone(),
                least_squares_end(best, declared.len()),
                evaluations,
                0.0,
            )
        }
        Norm::Max => minimax(&objective, &searches, options),
    }
}

/// Least-squares searches from all starts: on a subset first, the best carried on; best first.
fn searches(objective: &Objective, declared: &[f64], options: &Options) -> Result<Vec<Search>, FitError> {
    let starts = starts::starts(declared, options.starts, options.spread);
    let coarse = objective.samples.subset(COARSE.max(8 * declared.len()));
    let rough = Objective::new(objective.tape, &coarse)?;
    let first = run(&rough, &starts, options.iterations)?;
    let carried: Vec<Vec<f64>> = if coarse.len() == objective.samples.len() {
        if !first.is_empty() {
            return Ok(first);
        }
        starts
    } else {
        let best = first.iter().take(FINALISTS).map(|s| s.coefficients.clone());
        best.chain(std::iter::once(declared.to_vec())).collect()
    };
    let all = run(objective, &carried, options.iterations)?;
    if all.is_empty() {
        return Err(refused(objective, declared));
    }
    Ok(all)
}

/// Searches from every start that is not refused, sorted by (rms, order of start).
fn run(objective: &Objective, starts: &[Vec<f64>], iterations: u64) -> Result<Vec<Search>, FitError> {
    let outcomes: Vec<Result<Result<Search, _>, FitError>> =
        starts.par_iter().map(|start| search(objective, start, iterations)).collect();
    let mut searches = Vec::new();
    for outcome in outcomes {
        // A refused start is one fewer; that all are refused is the caller's to report.
        searches.extend(outcome?.ok());
    }
    searches.sort_by(|a: &Search, b: &Search| a.rms.total_cmp(&b.rms));
    Ok(searches)
}

/// Why the declared start was refused.
fn refused(objective: &Objective, declared: &[f64]) -> FitError {
    let index = objective.linearise(declared).err().map_or(0, |r| r.sample);
    let inputs: Vec<f64> = objective.samples.inputs.iter().map(|column| column[index]).collect();
    let value = objective.tape.at(&inputs, declared);
    let name = objective.tape.function();
    if value.is_finite() {
        let message = format!(
            "{name}: at the declared start a divisor changes sign among the samples, near sample {index}; \
             every other start failed too"
        );
        return FitError::Solver { message };
    }
    FitError::NotFinite { column: format!("{name}: value at the declared start"), index, value }
}

fn least_squares_end(search: &Search, parameters: usize) -> Termination {
    match search.end {
        End::Minimum { .. } | End::Zero if search.rank < parameters => {
            Termination::RankDeficient { rank: search.rank }
        }
        End::Minimum { cosine } => Termination::Converged { cosine },
        End::Zero => Termination::ZeroResidual,
        End::Stalled { .. } => Termination::Stalled,
        End::Cap => Termination::IterationCap,
    }
}

/// The best minimax descent from the finalists of the least-squares searches.
fn minimax(objective: &Objective, searches: &[Search], options: &Options) -> Result<Fitted, FitError> {
    let finalists = &searches[..searches.len().min(FINALISTS)];
    let descents: Vec<_> = finalists
        .par_iter()
        .map(|search| descend(objective, &search.coefficients, options.iterations))
        .collect();
    let mut evaluations: u64 = searches.iter().map(|s| s.evaluations).sum();
    let mut best: Option<(usize, minimax::Descent)> = None;
    for (index, descent) in descents.into_iter().enumerate() {
        // A finalist has been evaluated before: it cannot be refused now.
        let Ok(descent) = descent else { continue };
        evaluations += descent.evaluations;
        if best.as_ref().is_none_or(|(_, b)| descent.max < b.max) {
            best = Some((index, descent));
        }
    }
    let Some((index, best)) = best else { return Err(refused(objective, &searches[0].coefficients)) };
    let parameters = best.coefficients.len();
    let termination = match least_squares_end(&searches[index], parameters) {
        Termination::RankDeficient { rank } => Termination::RankDeficient { rank },
        Termination::ZeroResidual => Termination::ZeroResidual,
        _ if best.optimal => Termination::Minimax,
        _ if best.capped => Termination::IterationCap,
        _ => Termination::Stalled,
    };
    finish(objective, best.coefficients, termination, evaluations, best.gap)
}

fn finish(
    objective: &Objective,
    coefficients: Vec<f64>,
    termination: Termination,
    evaluations: u64,
    gap: f64,
) -> Result<Fitted, FitError> {
    let residuals = objective.residuals(&coefficients).map_err(|_| refused(objective, &coefficients))?;
    let (rms, max) = (rms(&residuals), largest(&residuals));
    Ok(Fitted { coefficients, termination, rms, max, evaluations, gap })
}

/// Largest and root mean square residual of a formula at its starting coefficients; none where it is not finite or a divisor
/// changes sign among the samples.
///
/// # Errors
/// Data that are not finite or of the wrong shape, with the index.
pub fn residual_range(hypothesis: &Hypothesis, samples: &Samples) -> Result<Option<(f64, f64)>, FitError> {
    let objective = Objective::new(hypothesis.tape(), samples)?;
    Ok(objective.residuals(&hypothesis.starts()).ok().map(|r| (largest(&r), rms(&r))))
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
        Err(FitError::NotFinite { column: "coefficient".to_string(), index, value })
    };
    coefficients.iter().enumerate().map(round).collect()
}
