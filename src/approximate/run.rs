//! The formulas of an effect fitted to a quantity, beside published formulas for the same use:
//! targets, samples, search, proof, certificates.

use super::prepared::Prepared;
use super::target::{Target, TargetSpec};
use super::{Counter, Dropped, Entry, Fit, FitSet, FitStageError, SafeRange};
use crate::data::{AlphaMap, Norm};
use lobefit_fit::FitError;
use lobefit_shade::{Hypothesis, ShadeError};
use rayon::prelude::*;

/// What to fit.
#[derive(Clone, Debug)]
pub struct Wanted<'a> {
    /// Quantity, use and domain.
    pub spec: TargetSpec,
    /// Hypotheses with free parameters.
    pub own: &'a [Entry],
    /// The user's hypotheses: file name and WGSL source.
    pub user: &'a [(String, String)],
    /// Published formulas, for comparison. A formula that takes roughness means
    /// alpha = roughness^2: under another map it is left out, since it would be judged on a
    /// misreading.
    pub published: Vec<&'a Entry>,
    /// Errors to minimise, one fit each.
    pub norms: &'a [Norm],
    /// Most operations of a fit; none: any.
    pub max_ops: Option<u32>,
    /// What the fits must keep beyond their domain.
    pub safe_range: Option<SafeRange>,
    /// A form of f0 of each minimax fit (of each other fit where there is none), measured at
    /// f0 = 1.
    pub with_f0: Option<WithF0>,
}

/// Makes a formula of f0 of another formula, given as it stands in its file; the second argument is
/// the name of its fit.
pub type WithF0 = fn(&Hypothesis, &str) -> Result<Hypothesis, ShadeError>;

/// Fits and measures: our formulas in the catalogue's order, the user's, their forms of f0, then
/// the published ones. A hypothesis of ours that does not converge, or has a pole, in this domain
/// is dropped with the reason, and so is a formula that was asked for and costs too much; a
/// hypothesis of the user's that does not converge is an error.
///
/// # Errors
/// A domain that the quantity does not have; a truth that cannot be integrated; a formula that
/// cannot be fitted.
pub fn fit_all(wanted: &Wanted, counter: &Counter) -> Result<FitSet, FitStageError> {
    // Parse first: a hypothesis that is refused must not cost a bake.
    let squared = wanted.spec.alpha_map == AlphaMap::RoughnessSquared;
    let published = wanted.published.iter().copied().filter(|entry| squared || !entry.takes("roughness"));
    let published: Vec<&Entry> = published.collect();
    let own = parse(wanted.own.iter().map(|entry| (entry.file, entry.source)))?;
    let user = parse(wanted.user.iter().map(|(file, source)| (file.as_str(), source.as_str())))?;
    let known = parse(published.iter().map(|entry| (entry.file, entry.source)))?;
    let mut dropped = Vec::new();
    let own: Vec<Hypothesis> = own.into_iter().filter(|h| wanted.affords(h)).collect();
    let stage = Stage::new(wanted, own.iter().chain(&user).chain(&known), counter)?;
    dropped.extend(user.iter().filter(|h| !wanted.affords(h)).map(|h| wanted.too_dear(h)));
    let user: Vec<Hypothesis> = user.into_iter().filter(|h| wanted.affords(h)).collect();
    let (jobs, results) = stage.fits(&own);
    let mut fits = kept(&jobs, results, &mut dropped)?;
    fits.extend(stage.fits(&user).1.into_iter().collect::<Result<Vec<Fit>, _>>()?);
    for form in stage.forms_of_f0(&fits)? {
        if wanted.affords(&form.hypothesis) {
            fits.push(form);
        } else {
            dropped.push(wanted.too_dear(&form.hypothesis));
        }
    }
    let pairs: Vec<(&Entry, &Hypothesis)> = published.into_iter().zip(&known).collect();
    let measured = pairs.par_iter().map(|(entry, h)| stage.of(h)?.published(entry, h));
    fits.extend(measured.collect::<Vec<_>>().into_iter().collect::<Result<Vec<Fit>, _>>()?);
    Ok(FitSet { fits, dropped })
}

fn parse<'a>(sources: impl Iterator<Item = (&'a str, &'a str)>) -> Result<Vec<Hypothesis>, ShadeError> {
    sources.map(|(file, source)| Hypothesis::parse(file, source)).collect()
}

impl Wanted<'_> {
    /// Whether a formula costs no more than the scene allows.
    pub fn affords(&self, hypothesis: &Hypothesis) -> bool {
        self.max_ops.is_none_or(|most| hypothesis.tape().cost_ops() <= most)
    }

    /// A formula that was asked for and costs more than the scene allows.
    pub fn too_dear(&self, hypothesis: &Hypothesis) -> Dropped {
        let (ops, most) = (hypothesis.tape().cost_ops(), self.max_ops.unwrap_or(u32::MAX));
        Dropped {
            hypothesis: hypothesis.name().to_string(),
            norm: "any",
            reason: format!("{}: {ops} operations, max_ops is {most}", hypothesis.file()),
        }
    }
}

/// The targets of formulas, with their samples.
struct Stage<'a> {
    wanted: &'a Wanted<'a>,
    prepared: Vec<Prepared>,
}

impl<'a> Stage<'a> {
    fn new<'b>(
        wanted: &'a Wanted<'a>,
        formulas: impl Iterator<Item = &'b Hypothesis>,
        counter: &Counter,
    ) -> Result<Stage<'a>, FitStageError> {
        let mut targets: Vec<Target> = Vec::new();
        for formula in formulas {
            let target = Target::new(&wanted.spec, formula)?;
            if !targets.contains(&target) {
                targets.push(target);
            }
        }
        let prepared = targets.into_iter().map(|target| Prepared::new(target, counter));
        Ok(Stage { wanted, prepared: prepared.collect::<Result<_, _>>()? })
    }

    /// The samples for a formula.
    fn of(&self, formula: &Hypothesis) -> Result<&Prepared, FitStageError> {
        among(&self.prepared, &Target::new(&self.wanted.spec, formula)?, formula)
    }

    /// Each formula in each norm, and its fit.
    fn fits(&self, formulas: &[Hypothesis]) -> (Vec<Job>, Vec<Result<Fit, FitStageError>>) {
        let norms =
            |h: &Hypothesis| self.wanted.norms.iter().map(|norm| (h.clone(), *norm)).collect::<Vec<_>>();
        let jobs: Vec<Job> = formulas.iter().flat_map(norms).collect();
        let fit = |(h, norm): &Job| self.of(h)?.fit(h, *norm, self.wanted.safe_range.as_ref());
        let results = jobs.par_iter().map(fit).collect();
        (jobs, results)
    }

    /// The forms of f0 that are asked for.
    fn forms_of_f0(&self, fits: &[Fit]) -> Result<Vec<Fit>, FitStageError> {
        let Some(make) = self.wanted.with_f0 else { return Ok(Vec::new()) };
        let norm = if self.wanted.norms.contains(&Norm::Max) { Norm::Max } else { Norm::Rms };
        let at_one: Vec<Prepared> = self.prepared.iter().map(|prepared| prepared.at_f0(1.0)).collect();
        let form = |fit: &&Fit| -> Result<Fit, FitStageError> {
            let original = Hypothesis::parse(fit.hypothesis.file(), fit.hypothesis.source())?;
            let form = make(&original, fit.hypothesis.name())?;
            let target = Target::new(&self.wanted.spec, &original)?.at_f0(1.0);
            among(&at_one, &target, &original)?.form(fit, form)
        };
        let fits: Vec<&Fit> = fits.iter().filter(|fit| fit.norm() == norm.name()).collect();
        fits.par_iter().map(form).collect::<Vec<_>>().into_iter().collect()
    }
}

/// The samples of a target, which a formula needs.
fn among<'a>(
    prepared: &'a [Prepared],
    target: &Target,
    formula: &Hypothesis,
) -> Result<&'a Prepared, FitStageError> {
    let found = prepared.iter().find(|prepared| prepared.target == *target);
    found.ok_or_else(|| FitStageError::Unprepared { hypothesis: formula.file().to_string() })
}

/// A formula and the norm of its fit.
type Job = (Hypothesis, Norm);

/// The fits among the results of the catalogue's jobs; what cannot be relied on is noted, any other
/// error handed on.
fn kept(
    jobs: &[Job],
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
