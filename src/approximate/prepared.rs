//! A target with its samples, and fits of one formula to it.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::certificate::{approximation, formula, worse};
use super::closer::{closer, half};
use super::search::{Searched, searched};
use super::target::{Sampled, Target};
use super::{Entry, Fit, FitStageError, Safe, SafeProof, SafeRange};
use crate::data::{Form, Half, HalfRefusal, Norm, Source};
use lobefit_fit::{Constraint, Options, Samples};
use lobefit_shade::code::Float;
use lobefit_shade::{Domain, Hypothesis, Precision};

/// Counts the truths that were integrated: how `bake` shows that nothing is computed which the
/// scene does not call for.
#[derive(Debug, Default)]
pub struct Counter(AtomicU64);

impl Counter {
    /// Notes `n` integrated points.
    pub fn add(&self, n: usize) {
        self.0.fetch_add(n as u64, Ordering::Relaxed);
    }

    /// Points integrated so far.
    pub fn total(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}

/// A target with its samples. Formulas that are affine in f0 and those that are not have different
/// ones.
pub(super) struct Prepared {
    pub target: Target,
    even: Sampled,
    edged: Sampled,
    measured: Arc<Sampled>,
}

impl Prepared {
    /// Integrates the truths of the samples.
    pub fn new(target: Target, counter: &Counter) -> Result<Prepared, FitStageError> {
        let measured = target.measured()?;
        counter.add(measured.integrals as usize);
        Prepared::measured_at(target, Arc::new(measured), counter)
    }

    /// The same where the points to certify at are integrated already.
    pub fn measured_at(
        target: Target,
        measured: Arc<Sampled>,
        counter: &Counter,
    ) -> Result<Prepared, FitStageError> {
        let (even, edged) = (target.even()?, target.edged()?);
        counter.add((even.integrals + edged.integrals) as usize);
        Ok(Prepared { target, even, edged, measured })
    }

    /// A formula's best coefficients, proven and measured.
    pub fn fit(&self, hypothesis: &Hypothesis, search: &Search) -> Result<Fit, FitStageError> {
        let Search { norm, safe_range, by } = *search;
        let sampled = match norm {
            Norm::Max => &self.edged,
            Norm::Rms => &self.even,
        };
        let samples = sampled.samples(hypothesis.name(), hypothesis.inputs(), None)?;
        let domain = self.target.domain()?;
        let (found, safe) = match safe_range {
            None if by == By::Us => (patiently(hypothesis, norm, &samples, &domain)?, None),
            None => (searched(hypothesis, norm, (&samples, &[]), &domain, (&Options::new(norm), 0.0))?, None),
            Some(safe_range) => {
                let (found, safe) = keeping(hypothesis, norm, &samples, &domain, safe_range)?;
                (found, Some(safe))
            }
        };
        let Searched { hypothesis, coefficients, termination } = found;
        let fit = self.measure(hypothesis, &coefficients, norm.name(), Source::Fitted)?;
        Ok(Fit { termination: Some(termination), emitted: true, safe, ..fit })
    }

    /// A published formula with its constants, measured like ours.
    pub fn published(&self, entry: &Entry, hypothesis: &Hypothesis) -> Result<Fit, FitStageError> {
        let source = Source::Published(entry.publication.unwrap_or_default().to_string());
        self.measure(hypothesis.clone(), &[], "published", source)
    }

    /// A fit as it is called: the same coefficients in a function of other arguments. Its name and
    /// its cost are those of its formula, for which roughness and alpha are both given.
    pub fn called(&self, fit: &Fit, hypothesis: Hypothesis) -> Result<Fit, FitStageError> {
        let mut called = self.measure(hypothesis, &fit.coefficients(), fit.norm(), Source::Fitted)?;
        called.approximation.name.clone_from(&fit.approximation.name);
        called.approximation.cost = fit.approximation.cost;
        Ok(Fit {
            termination: fit.termination,
            price: fit.price,
            emitted: true,
            safe: fit.safe.clone(),
            ..called
        })
    }

    /// Measures an emitted fit in half precision, unless it was.
    pub fn halve(&self, fit: &mut Fit) -> Result<(), FitStageError> {
        let (hypothesis, coefficients) = (&fit.hypothesis, fit.coefficients());
        if let Form::Formula(formula) = &mut fit.approximation.form
            && formula.half.is_none()
        {
            let found = half(hypothesis, &coefficients, &self.target, &self.measured)?;
            formula.half = Some(Half::from(&found));
        }
        Ok(())
    }

    /// Measures a formula in the numbers that it is emitted with.
    ///
    /// # Errors
    /// A formula of f16 that is not finite there.
    fn measure(
        &self,
        hypothesis: Hypothesis,
        coefficients: &[f32],
        norm: &str,
        source: Source,
    ) -> Result<Fit, FitStageError> {
        let mut form = formula(&hypothesis, coefficients, norm);
        let mut found = closer(&hypothesis, coefficients, &self.target, &self.measured, Precision::F32)?;
        if hypothesis.float() == Float::F16 {
            let half = half(&hypothesis, coefficients, &self.target, &self.measured)?;
            form.half = Some(Half::from(&half));
            // A compiler may keep f32 where f16 is enough.
            let refused = |refusal: HalfRefusal| FitStageError::Refused {
                hypothesis: hypothesis.file().into(),
                norm: norm.into(),
                reason: refusal.refused,
            };
            found = worse(half.map_err(refused)?, found);
        }
        let approximation = approximation(&hypothesis, form, &self.target, source, found);
        let (termination, emitted, recommended, safe) = (None, false, false, None);
        let price = f64::from(approximation.cost.ops);
        Ok(Fit { approximation, hypothesis, termination, price, emitted, recommended, safe })
    }
}

/// What a formula's coefficients are to keep, and how long they are searched.
#[derive(Clone, Copy)]
pub(super) struct Search<'a> {
    pub norm: Norm,
    /// What they keep beyond the domain.
    pub safe_range: Option<&'a SafeRange>,
    pub by: By,
}

/// Who wrote a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum By {
    /// The catalogue: its starting values are a fit's, and a search goes on for longer.
    Us,
    /// The user.
    User,
}

/// Part of the error below which what is left to gain is no reason to do without a fit. Its certificate
/// is measured like any other.
const LITTLE: f64 = 0.01;

/// The best coefficients of a formula of ours. Where no search ends at a minimum, one goes on from the
/// starting values alone, from which a narrower domain is near, and may end with little left to gain.
fn patiently(
    hypothesis: &Hypothesis,
    norm: Norm,
    samples: &Samples,
    domain: &Domain,
) -> Result<Searched, FitStageError> {
    let usual = Options::new(norm);
    let within =
        |options: &Options, near: f64| searched(hypothesis, norm, (samples, &[]), domain, (options, near));
    within(&usual, 0.0).or_else(|error| match error {
        FitStageError::NotConverged { .. } => {
            within(&Options { starts: 1, iterations: ITERATIONS, ..usual }, LITTLE)
        }
        error => Err(error),
    })
}

/// Iterations of a search that must keep something, or did not end: the longest formulas lie in narrow
/// valleys, and take some 400 where f0 or the region are not those that their starting values are for.
const ITERATIONS: u64 = 800;

/// The best coefficients, if they keep what they must; else the best of those that do.
///
/// The starting values of such formulas are a fit's: a search from there alone ends where one from
/// eight starts does (measured at f0 = 0.04 and over 0.02 to 0.2, on the five longest) in a third
/// of the time. Where it ends nowhere the others are tried; where those do not either, the formula
/// is not for this domain.
fn keeping(
    hypothesis: &Hypothesis,
    norm: Norm,
    samples: &Samples,
    domain: &Domain,
    safe_range: &SafeRange,
) -> Result<(Searched, Safe), FitStageError> {
    let usual = Options::new(norm);
    let alone = Options { starts: 1, iterations: ITERATIONS, ..usual };
    let within = |constraints: &[Constraint], options| {
        searched(hypothesis, norm, (samples, constraints), domain, (options, 0.0))
    };
    let free = within(&[], &alone).or_else(|_| within(&[], &usual))?;
    if let SafeProof::Proven(safe) = safe_range.prove(hypothesis, &free.coefficients)? {
        return Ok((free, safe));
    }
    let bound = within(&safe_range.constraints(hypothesis)?, &alone)?;
    match safe_range.prove(hypothesis, &bound.coefficients)? {
        SafeProof::Proven(safe) => Ok((bound, safe)),
        SafeProof::Unproven(reason) => {
            let (hypothesis, norm) = (hypothesis.file().to_string(), norm.name());
            Err(FitStageError::Unkept { hypothesis, norm, reason })
        }
    }
}
