//! A target with its samples, and fits of one formula to it.

use std::sync::Arc;

use super::certificate::{approximation, formula, worse};
use super::closer::{Places, closer, half};
use super::search::{named_for, searched};
use super::target::{Sampled, Target, TargetError};
use super::{Entry, Fit, FitStageError, Memo, Safe, SafeProof, SafeRange};
use crate::data::{Certificate, Form, Half, HalfRefusal, Norm, Source};
use crate::store::Key;
use lobefit_fit::{Constraint, Options, Samples};
use lobefit_shade::code::Float;
use lobefit_shade::{Domain, Hypothesis, Precision, RangeProof, prove_range};

/// A target with its samples. Formulas that are affine in f0 and those that are not have different
/// ones.
pub(super) struct Prepared<'a> {
    pub target: Target,
    even: Sampled,
    edged: Sampled,
    measured: Arc<Sampled>,
    memo: &'a Memo<'a>,
}

impl<'a> Prepared<'a> {
    /// Integrates the truths of the samples.
    pub fn new(target: Target, memo: &'a Memo) -> Result<Prepared<'a>, FitStageError> {
        let measured = target.measured(memo)?;
        memo.add(measured.integrals as usize);
        Prepared::measured_at(target, Arc::new(measured), memo)
    }

    /// The same where the points to certify at are integrated already.
    pub fn measured_at(
        target: Target,
        measured: Arc<Sampled>,
        memo: &'a Memo,
    ) -> Result<Prepared<'a>, FitStageError> {
        let (even, edged) = (target.even(memo)?, target.edged(memo)?);
        memo.add((even.integrals + edged.integrals) as usize);
        Ok(Prepared { target, even, edged, measured, memo })
    }

    /// A formula's best coefficients, proven and measured.
    ///
    /// # Errors
    /// A formula of ours without a fit to rely on in this domain: [`FitStageError::Unreliable`]; of the
    /// user's the reason itself.
    pub fn fit(&self, hypothesis: &Hypothesis, search: &Search) -> Result<Fit, FitStageError> {
        let key = self.key("fit", hypothesis).with(&format!("{search:?}"));
        let found = self.memo.kept(key, || match self.search(hypothesis, search) {
            Err(error) if search.by == By::Us && error.is_unreliable() => Ok(Err(error.reason())),
            found => found.map(Ok),
        });
        let (coefficients, safe) = found?.map_err(|reason| FitStageError::Unreliable { reason })?;
        let hypothesis = named_for(hypothesis, search.norm.into());
        let fit = self.measure(hypothesis, &coefficients, search.norm.name(), Source::Fitted)?;
        Ok(Fit { emitted: true, safe, ..fit })
    }

    /// Where formulas are measured.
    fn places(&self) -> Places<'_> {
        Places { target: &self.target, measured: &self.measured, memo: self.memo }
    }

    /// What a result for a formula depends on.
    fn key(&self, kind: &'static str, hypothesis: &Hypothesis) -> Key {
        let target = format!("{:?} {:?} {:?}", self.target, hypothesis.float(), hypothesis.inputs());
        let texts = [hypothesis.file(), hypothesis.name(), hypothesis.source()];
        texts.into_iter().fold(Key::of(kind).with(&target), Key::with)
    }

    /// Coefficients that are proven, and where they keep what they must.
    fn search(
        &self,
        hypothesis: &Hypothesis,
        search: &Search,
    ) -> Result<(Vec<f32>, Option<Safe>), FitStageError> {
        let Search { norm, safe_range, by } = *search;
        let sampled = match norm {
            Norm::Max => &self.edged,
            Norm::Rms => &self.even,
        };
        let samples = sampled.samples(hypothesis.name(), hypothesis.inputs(), None)?;
        let domain = self.target.proven(hypothesis)?;
        let (found, safe) = match safe_range {
            None if by == By::Us => (patiently(hypothesis, norm, &samples, &domain)?, None),
            None => (searched(hypothesis, norm, (&samples, &[]), &domain, (&Options::new(norm), 0.0))?, None),
            Some(safe_range) => {
                let (found, safe) = keeping(hypothesis, norm, &samples, &domain, safe_range)?;
                (found, Some(safe))
            }
        };
        if self.target.has_one_value() {
            not_negative(hypothesis, norm, &found, &domain)?;
            not_rounding(hypothesis, norm, &found, &samples)?;
        }
        Ok((found, safe))
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
        Ok(Fit { price: fit.price, emitted: true, safe: fit.safe.clone(), ..called })
    }

    /// Measures an emitted fit in half precision, unless it was.
    pub fn halve(&self, fit: &mut Fit) -> Result<(), FitStageError> {
        let (hypothesis, coefficients) = (&fit.hypothesis, fit.coefficients());
        if let Form::Formula(formula) = &mut fit.approximation.form
            && formula.half.is_none()
        {
            formula.half = Some(Half::from(&self.half(hypothesis, &coefficients)?));
        }
        Ok(())
    }

    /// Measures a formula in half precision.
    fn half(
        &self,
        hypothesis: &Hypothesis,
        coefficients: &[f32],
    ) -> Result<Result<Certificate, HalfRefusal>, TargetError> {
        let key = self.key("half", hypothesis).numbers(&wide(coefficients));
        self.memo.kept(key, || half(hypothesis, coefficients, &self.places()))
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
        let in_f32 = || closer(&hypothesis, coefficients, &self.places(), Precision::F32);
        let key = self.key("certificate", &hypothesis).numbers(&wide(coefficients));
        let mut found = self.memo.kept(key, in_f32)?;
        if hypothesis.float() == Float::F16 {
            let half = self.half(&hypothesis, coefficients)?;
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
        let (emitted, recommended, safe) = (false, false, None);
        let price = f64::from(approximation.cost.ops);
        Ok(Fit { approximation, hypothesis, price, emitted, recommended, safe })
    }
}

fn wide(coefficients: &[f32]) -> Vec<f64> {
    coefficients.iter().map(|c| f64::from(*c)).collect()
}

/// Refuses coefficients with a value below 0 where they are proven to have no pole: what is fitted is an
/// albedo, a factor or a width.
fn not_negative(
    hypothesis: &Hypothesis,
    norm: Norm,
    coefficients: &[f32],
    domain: &Domain,
) -> Result<(), FitStageError> {
    let found = prove_range(hypothesis.tape(), &wide(coefficients), domain, 0.0, f64::INFINITY)?;
    let RangeProof::Violated { at, value } = found else { return Ok(()) };
    let (hypothesis, norm) = (hypothesis.file().to_string(), norm.name());
    Err(FitStageError::Unkept { hypothesis, norm, reason: format!("it is {value:.2e} at {at}") })
}

/// Rounding in f32 that a fit may have whatever its error, and as a part of its error.
const ROUNDED: (f64, f64) = (1e-6, 0.1);

/// Refuses coefficients whose values in f32 are off by rounding alone, as where a pole and a zero nearly
/// cancel: the largest of errors that change from one float to the next is at none of the points measured.
fn not_rounding(
    hypothesis: &Hypothesis,
    norm: Norm,
    coefficients: &[f32],
    samples: &Samples,
) -> Result<(), FitStageError> {
    let narrow: Vec<Vec<f32>> =
        samples.inputs.iter().map(|column| column.iter().map(|x| *x as f32).collect()).collect();
    let rounded = hypothesis.tape().evaluate(&narrow, coefficients)?;
    let exact = hypothesis.tape().evaluate(&samples.inputs, &wide(coefficients))?;
    let (mut rounding, mut error) = (0.0_f64, 0.0_f64);
    for (i, (rounded, exact)) in rounded.into_iter().zip(exact).enumerate() {
        rounding = rounding.max((samples.scale[i] * (f64::from(rounded) - exact)).abs());
        error = error.max((samples.scale[i] * exact - samples.target[i]).abs());
    }
    let (always, part) = ROUNDED;
    if rounding <= always.max(part * error) {
        return Ok(());
    }
    let (hypothesis, norm) = (hypothesis.file().to_string(), norm.name().to_string());
    let reason = format!("f32 rounds its values by up to {rounding:.1e}, and it errs by {error:.1e} without");
    Err(FitStageError::Refused { hypothesis, norm, reason })
}

/// What a formula's coefficients are to keep, and how long they are searched.
#[derive(Clone, Copy, Debug)]
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
) -> Result<Vec<f32>, FitStageError> {
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
) -> Result<(Vec<f32>, Safe), FitStageError> {
    let usual = Options::new(norm);
    let alone = Options { starts: 1, iterations: ITERATIONS, ..usual };
    let within = |constraints: &[Constraint], options| {
        searched(hypothesis, norm, (samples, constraints), domain, (options, 0.0))
    };
    let free = within(&[], &alone).or_else(|_| within(&[], &usual))?;
    if let SafeProof::Proven(safe) = safe_range.prove(hypothesis, &free)? {
        return Ok((free, safe));
    }
    let bound = within(&safe_range.constraints(hypothesis)?, &alone)?;
    match safe_range.prove(hypothesis, &bound)? {
        SafeProof::Proven(safe) => Ok((bound, safe)),
        SafeProof::Unproven(reason) => {
            let (hypothesis, norm) = (hypothesis.file().to_string(), norm.name());
            Err(FitStageError::Unkept { hypothesis, norm, reason })
        }
    }
}
