//! The catalogue's hypotheses fitted to a target, beside published formulas for the same use.

use super::target::{Sampled, Target, TargetSpec};
use super::{Counter, Dropped, Fit, FitSet, FitStageError, Searched, formula, searched, searched_within};
use super::{Entry, Keeps, Kept, Safe};
use crate::data::{Approximation, Certificate, Cost, Form, Norm, Source};
use lobefit_fit::{Constraint, FitError, Options, Samples};
use lobefit_shade::{Domain, Hypothesis, ShadeError, measure_first, round_up};
use rayon::prelude::*;

/// What to fit.
#[derive(Clone, Debug)]
pub struct Wanted<'a> {
    /// Quantity, use and domain.
    pub spec: TargetSpec,
    /// Hypotheses with free parameters.
    pub own: &'a [Entry],
    /// Published formulas, for comparison.
    pub rivals: Vec<&'a Entry>,
    /// Errors to minimise, one fit each.
    pub norms: &'a [Norm],
    /// Most operations of a fit; none: any.
    pub max_ops: Option<u32>,
    /// What the fits must keep beyond their domain.
    pub keeps: Option<Keeps>,
}

/// A target with its samples. Formulas that are affine in f0 and those that are not have different ones.
struct Ready {
    target: Target,
    even: Sampled,
    edged: Sampled,
    measured: Sampled,
}

/// Fits and measures everything in the catalogue's order, then the rivals. A hypothesis that does not converge, or has a pole, in
/// this domain is dropped with the reason.
///
/// # Errors
/// A domain that the quantity does not have; a truth that cannot be integrated.
pub fn fit_all(wanted: &Wanted, counter: &Counter) -> Result<FitSet, FitStageError> {
    let own = parse(wanted.own.iter())?;
    let affordable = |h: &&Hypothesis| wanted.max_ops.is_none_or(|most| h.tape().cost_ops() <= most);
    let own: Vec<&Hypothesis> = own.iter().filter(affordable).collect();
    let rivals = parse(wanted.rivals.iter().copied())?;
    let mut ready: Vec<Ready> = Vec::new();
    let mut prepare = |hypothesis: &Hypothesis| -> Result<usize, FitStageError> {
        let target = Target::new(&wanted.spec, hypothesis)?;
        if let Some(known) = ready.iter().position(|r| r.target == target) {
            return Ok(known);
        }
        ready.push(Ready::new(target, counter)?);
        Ok(ready.len() - 1)
    };
    let of_own: Vec<usize> = own.iter().map(|h| prepare(h)).collect::<Result<_, _>>()?;
    let of_rivals: Vec<usize> = rivals.iter().map(prepare).collect::<Result<_, _>>()?;
    let each_norm = |(h, index): (&&Hypothesis, &usize)| {
        let (h, index) = ((*h).clone(), *index);
        wanted.norms.iter().map(move |norm| ((h.clone(), *norm), index))
    };
    let (jobs, indices): (Vec<(Hypothesis, Norm)>, Vec<usize>) =
        own.iter().zip(&of_own).flat_map(each_norm).unzip();
    let results = jobs
        .par_iter()
        .zip(&indices)
        .map(|((h, norm), index)| ready[*index].fit(h, *norm, wanted.keeps.as_ref()))
        .collect();
    let mut dropped = Vec::<Dropped>::new();
    let mut fits = kept(&jobs, results, &mut dropped)?;
    for ((entry, hypothesis), index) in wanted.rivals.iter().zip(&rivals).zip(of_rivals) {
        fits.push(ready[index].published(entry, hypothesis)?);
    }
    Ok(FitSet { fits, dropped })
}

fn parse<'a>(entries: impl Iterator<Item = &'a Entry>) -> Result<Vec<Hypothesis>, ShadeError> {
    entries.map(|entry| Hypothesis::parse(entry.file, entry.source)).collect()
}

impl Ready {
    fn new(target: Target, counter: &Counter) -> Result<Ready, FitStageError> {
        let (even, edged, measured) = (target.even()?, target.edged()?, target.measured()?);
        counter.add(even.points.len() + edged.points.len() + measured.points.len());
        Ok(Ready { target, even, edged, measured })
    }

    fn fit(&self, hypothesis: &Hypothesis, norm: Norm, keeps: Option<&Keeps>) -> Result<Fit, FitStageError> {
        let sampled = match norm {
            Norm::Max => &self.edged,
            Norm::Rms => &self.even,
        };
        let samples = sampled.samples(hypothesis.name(), hypothesis.inputs(), None)?;
        let domain = self.target.domain()?;
        let (found, safe) = match keeps {
            None => (searched(hypothesis, norm, &samples, &domain)?, None),
            Some(keeps) => {
                let (found, safe) = keeping(hypothesis, norm, &samples, &domain, keeps)?;
                (found, Some(safe))
            }
        };
        let approximation =
            self.certified(&found.hypothesis, &found.coefficients, norm.name(), Source::Fitted)?;
        Ok(Fit {
            approximation,
            hypothesis: found.hypothesis,
            termination: Some(found.termination),
            emitted: true,
            wraps: None,
            safe,
        })
    }

    fn published(&self, entry: &Entry, hypothesis: &Hypothesis) -> Result<Fit, FitStageError> {
        let source = Source::Published(entry.publication.unwrap_or_default().to_string());
        let approximation = self.certified(hypothesis, &[], "published", source)?;
        Ok(Fit {
            approximation,
            hypothesis: hypothesis.clone(),
            termination: None,
            emitted: false,
            wraps: None,
            safe: None,
        })
    }

    /// Measures a formula at points that it was not fitted on, in f32 as emitted.
    fn certified(
        &self,
        hypothesis: &Hypothesis,
        coefficients: &[f32],
        norm: &str,
        source: Source,
    ) -> Result<Approximation, FitStageError> {
        let Sampled { points, scale, target } = &self.measured;
        let inputs = self.measured.inputs(hypothesis.name(), hypothesis.inputs())?;
        let (all, uniform) =
            measure_first(hypothesis.tape(), coefficients, &inputs, scale, target, points.uniform)?;
        let certificate = Certificate {
            max_abs: round_up(all.max_abs, 4),
            max_rel: round_up(all.max_rel, 4),
            rms: uniform.rms,
            mean: uniform.mean,
            at: points.place(all.worst),
            domain: self.target.ranges(),
            precision: "f32".into(),
            points: all.points as u64,
        };
        Ok(Approximation {
            name: hypothesis.name().to_string(),
            quantity: self.target.quantity.name().into(),
            column: self.target.column.into(),
            used_as: self.target.used_as,
            smith: self.target.variant.smith,
            source,
            form: Form::Formula(formula(hypothesis, coefficients, norm)),
            certificate,
            cost: Cost { ops: hypothesis.tape().cost_ops(), fetches: 0, bytes: 0 },
        })
    }
}

/// Iterations of a search that must keep something: the longest formulas lie in narrow valleys, and take some 400 where f0 or the
/// region are not those that their starting values are for.
const ITERATIONS: u64 = 800;

/// The best coefficients, if they keep what they must; else the best of those that do.
///
/// The starting values of such formulas are a fit's: a search from there alone ends where one from eight starts does (measured at f0 =
/// 0.04 and over 0.02 to 0.2, on the five longest) in a third of the time. Where it ends nowhere the others are tried; where those do not either, the formula is not for this domain.
fn keeping(
    hypothesis: &Hypothesis,
    norm: Norm,
    samples: &Samples,
    domain: &Domain,
    keeps: &Keeps,
) -> Result<(Searched, Safe), FitStageError> {
    let usual = Options::new(norm);
    let alone = Options { starts: 1, iterations: ITERATIONS, ..usual };
    let within = |constraints: &[Constraint], options| {
        searched_within(hypothesis, norm, (samples, constraints), domain, options)
    };
    let free = within(&[], &alone).or_else(|_| within(&[], &usual))?;
    if let Kept::Proven(safe) = keeps.prove(hypothesis, &free.coefficients)? {
        return Ok((free, safe));
    }
    let bound = within(&keeps.constraints(hypothesis), &alone)?;
    match keeps.prove(hypothesis, &bound.coefficients)? {
        Kept::Proven(safe) => Ok((bound, safe)),
        Kept::Unproven(reason) => {
            let (hypothesis, norm) = (hypothesis.file().to_string(), norm.name());
            Err(FitStageError::Unkept { hypothesis, norm, reason })
        }
    }
}

/// The fits among the results of the catalogue's jobs; what cannot be relied on is noted, any other error handed on.
pub(crate) fn kept(
    jobs: &[(Hypothesis, Norm)],
    results: Vec<Result<Fit, FitStageError>>,
    dropped: &mut Vec<Dropped>,
) -> Result<Vec<Fit>, FitStageError> {
    let mut fits = Vec::new();
    for ((hypothesis, norm), result) in jobs.iter().zip(results) {
        match result {
            Ok(fit) => fits.push(fit),
            Err(
                error @ (FitStageError::NotConverged { .. }
                | FitStageError::RunAway { .. }
                | FitStageError::Unkept { .. }
                | FitStageError::Fit(FitError::Shade(ShadeError::Irregular { .. }))),
            ) => dropped.push(Dropped {
                hypothesis: hypothesis.name().to_string(),
                norm: norm.name(),
                reason: error.to_string(),
            }),
            Err(error) => return Err(error),
        }
    }
    Ok(fits)
}
