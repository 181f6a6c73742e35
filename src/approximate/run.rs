//! The formulas of an effect fitted to a quantity, beside published formulas for the same use:
//! targets, samples, search, proof, certificates.

use std::sync::Arc;

use super::prepared::{By, Prepared, Search};
use super::target::{Sampled, Target, TargetSpec};
use super::{Dropped, Emission, Entry, Fit, FitSet, FitStageError, Formulas, Memo, SafeRange};
use crate::data::{AlphaMap, Norm, Pick};
use lobefit_shade::code::Float;
use lobefit_shade::{Hypothesis, ShadeError};
use rayon::prelude::*;

/// What to fit.
#[derive(Clone, Debug)]
pub struct Wanted<'a> {
    /// Quantity, use and domain.
    pub spec: TargetSpec,
    /// Hypotheses with free parameters.
    pub own: Formulas<'a>,
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
    /// Which of the fits of our formulas are emitted; the user's all are.
    pub emission: Emission,
}

/// Fits and measures: our formulas in the catalogue's order, the user's, then the published ones. A
/// hypothesis of ours that does not converge, or has a pole, in this domain is dropped with the
/// reason, and so is a formula that was asked for and costs too much; a hypothesis of the user's
/// that does not converge is an error.
///
/// # Errors
/// A domain that the quantity does not have; a truth that cannot be integrated; a formula that
/// cannot be fitted.
pub fn fit_all(wanted: &Wanted, memo: &Memo) -> Result<FitSet, FitStageError> {
    // Parse first: a hypothesis that is refused must not cost a bake.
    let squared = wanted.spec.alpha_map == AlphaMap::RoughnessSquared;
    let published = wanted.published.iter().copied().filter(|entry| squared || !entry.takes("roughness"));
    let enough = wanted.emission.enough(wanted.max_ops);
    let published: Vec<&Entry> = published.filter(|_| enough.is_none()).collect();
    let float = wanted.emission.float;
    let own = parse(sources(wanted.formulas()), float)?;
    let user = parse(wanted.user.iter().map(|(file, source)| (file.as_str(), source.as_str())), float)?;
    let known = parse(sources(published.iter().copied()), Float::F32)?;
    let mut dropped = Vec::new();
    let (own, dear) = wanted.affordable(own)?;
    let stage = Stage::new(wanted, own.iter().chain(&user).chain(&known), memo, &[])?;
    let (user, too_dear) = wanted.affordable(user)?;
    for h in &too_dear {
        dropped.extend(wanted.too_dear(h)?);
    }
    let (jobs, results) = match enough {
        Some(limit) => stage.fits_within(own, limit)?,
        None => stage.fits(&own, By::Us),
    };
    let mut fits = kept(&jobs, results, &mut dropped)?;
    stage.pick(&mut fits)?;
    fits.extend(stage.fits(&user, By::User).1.into_iter().collect::<Result<Vec<Fit>, _>>()?);
    let emitted = fits.par_iter_mut().filter(|fit| fit.emitted);
    emitted.map(|fit| stage.of(&fit.hypothesis)?.halve(fit)).collect::<Result<(), _>>()?;
    stage.recommend(&mut fits);
    let nearest = if stage.misses(&fits) { Some(stage.nearest(&fits, dear, memo)?) } else { None };
    let mut measured = stage.published(&published, &known)?;
    // Some of them are emitted then.
    if wanted.emission.pick == Pick::All {
        let halve = |fit: &mut Fit| stage.of(&fit.hypothesis)?.halve(fit);
        measured.par_iter_mut().map(halve).collect::<Result<(), _>>()?;
    }
    fits.extend(measured);
    Ok(FitSet { fits, dropped, nearest, unserved: Vec::new() })
}

/// Fits and measures what a formula of the user's is compared with, in f32: our formulas without
/// those that have no reliable fit, then the published ones. Nothing of it is emitted. `known` is a
/// target whose points to certify at are integrated already.
///
/// # Errors
/// As [`fit_all`].
pub fn compared(wanted: &Wanted, known: (&Target, &Arc<Sampled>)) -> Result<Vec<Fit>, FitStageError> {
    let own = parse(sources(wanted.formulas()), Float::F32)?;
    let published = parse(sources(wanted.published.iter().copied()), Float::F32)?;
    let memo = Memo::default();
    let stage = Stage::new(wanted, own.iter().chain(&published), &memo, &[known])?;
    let (jobs, results) = stage.fits(&own, By::Us);
    let mut fits = kept(&jobs, results, &mut Vec::new())?;
    fits.extend(stage.published(&wanted.published, &published)?);
    Ok(fits)
}

fn sources<'a>(entries: impl IntoIterator<Item = &'a Entry>) -> impl Iterator<Item = (&'a str, &'a str)> {
    entries.into_iter().map(|entry| (entry.file, entry.source))
}

fn parse<'a>(
    sources: impl Iterator<Item = (&'a str, &'a str)>,
    float: Float,
) -> Result<Vec<Hypothesis>, ShadeError> {
    sources.map(|(file, source)| Ok(Hypothesis::parse(file, source)?.in_float(float))).collect()
}

impl<'a> Wanted<'a> {
    /// Our formulas for the inputs that vary.
    pub fn formulas(&self) -> &'a [Entry] {
        self.own.suiting(&self.spec)
    }

    /// Formulas that cost no more than the scene allows, and those that do.
    fn affordable(
        &self,
        formulas: Vec<Hypothesis>,
    ) -> Result<(Vec<Hypothesis>, Vec<Hypothesis>), FitStageError> {
        let (mut affordable, mut dear) = (Vec::new(), Vec::new());
        for h in formulas {
            if self.too_dear(&h)?.is_none() { affordable.push(h) } else { dear.push(h) }
        }
        Ok((affordable, dear))
    }

    /// What is said of a formula that costs more than the scene allows; none of another.
    ///
    /// # Errors
    /// No model of the vendor's GPUs.
    pub fn too_dear(&self, hypothesis: &Hypothesis) -> Result<Option<Dropped>, FitStageError> {
        let ops = self.emission.call.ops(hypothesis.tape().cost_ops());
        let reason = match (self.max_ops, self.emission.beyond(hypothesis)?) {
            (Some(most), _) if ops > most => format!("{ops} operations, max_ops is {most}"),
            (_, Some(price)) => {
                format!("cost {price:.1}, the budget is {}", self.emission.budget.unwrap_or(f64::INFINITY))
            }
            _ => return Ok(None),
        };
        let reason = format!("{}: {reason}", hypothesis.file());
        Ok(Some(Dropped { hypothesis: hypothesis.name().to_string(), norm: "any", reason }))
    }
}

/// The targets of formulas, with their samples.
struct Stage<'a> {
    wanted: &'a Wanted<'a>,
    prepared: Vec<Prepared<'a>>,
}

impl<'a> Stage<'a> {
    fn new<'b>(
        wanted: &'a Wanted<'a>,
        formulas: impl Iterator<Item = &'b Hypothesis>,
        memo: &'a Memo,
        known: &[(&Target, &Arc<Sampled>)],
    ) -> Result<Stage<'a>, FitStageError> {
        let mut targets: Vec<Target> = Vec::new();
        for formula in formulas {
            let target = Target::new(&wanted.spec, formula)?;
            if !targets.contains(&target) {
                targets.push(target);
            }
        }
        let prepared =
            targets.into_iter().map(|target| match known.iter().find(|(known, _)| **known == target) {
                Some((_, measured)) => Prepared::measured_at(target, Arc::clone(measured), memo),
                None => Prepared::new(target, memo),
            });
        Ok(Stage { wanted, prepared: prepared.collect::<Result<_, _>>()? })
    }

    /// The samples for a formula.
    fn of(&self, formula: &Hypothesis) -> Result<&Prepared<'_>, FitStageError> {
        among(&self.prepared, &Target::new(&self.wanted.spec, formula)?, formula)
    }

    /// Each formula in each norm, and its fit.
    fn fits(&self, formulas: &[Hypothesis], by: By) -> Results {
        let norms =
            |h: &Hypothesis| self.wanted.norms.iter().map(|norm| (h.clone(), *norm)).collect::<Vec<_>>();
        let jobs: Vec<Job> = formulas.iter().flat_map(norms).collect();
        let fit = |(h, norm): &Job| {
            let price = self.wanted.emission.price(h)?;
            let search = Search { norm: *norm, safe_range: self.wanted.safe_range.as_ref(), by };
            Ok(Fit { price, ..self.of(h)?.fit(h, &search)? })
        };
        let results = jobs.par_iter().map(fit).collect();
        (jobs, results)
    }

    /// The fits of formulas of growing cost, until the one to take in each norm is among them.
    fn fits_within(&self, formulas: Vec<Hypothesis>, limit: f64) -> Result<Results, FitStageError> {
        let Wanted { emission, norms, .. } = self.wanted;
        let price = |h: Hypothesis| Ok((emission.price(&h)?, h));
        let mut priced = formulas.into_iter().map(price).collect::<Result<Vec<_>, FitStageError>>()?;
        priced.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_within = |h: &Hypothesis| emission.within.is_some_and(|most| h.tape().cost_ops() <= most);
        let (within, mut priced): (Vec<_>, Vec<_>) = priced.into_iter().partition(|(_, h)| is_within(h));
        let formulas = |some: Vec<(f64, Hypothesis)>| some.into_iter().map(|(_, h)| h).collect::<Vec<_>>();
        let (mut jobs, mut results) = self.fits(&formulas(within), By::Us);
        while let Some((least, _)) = priced.first() {
            let fits: Vec<&Fit> = results.iter().flatten().collect();
            if norms.iter().all(|norm| emission.settled(&fits, *norm, limit, *least)) {
                break;
            }
            // Formulas of one price go together: of equals the more accurate is taken.
            let last = priced[TOGETHER.min(priced.len()) - 1].0;
            let rest = priced.split_off(priced.partition_point(|(price, _)| *price <= last));
            let (more, fits) = self.fits(&formulas(priced), By::Us);
            jobs.extend(more);
            results.extend(fits);
            priced = rest;
        }
        Ok((jobs, results))
    }

    /// Published formulas, measured.
    fn published(&self, entries: &[&Entry], formulas: &[Hypothesis]) -> Result<Vec<Fit>, FitStageError> {
        let measured = entries.par_iter().zip(formulas).map(|(entry, h)| {
            let price = self.wanted.emission.price(h)?;
            Ok(Fit { price, ..self.of(h)?.published(entry, h)? })
        });
        measured.collect::<Vec<_>>().into_iter().collect()
    }

    /// Whether one fit was asked for, and every fit is over the budget or misses the stated error.
    fn misses(&self, fits: &[Fit]) -> bool {
        let Emission { pick, max_error, .. } = self.wanted.emission;
        let limit = max_error.unwrap_or(f64::INFINITY);
        let keeps = |fit: &Fit| fit.emitted && fit.approximation.certificate.max_abs <= limit;
        pick == Pick::Best && !self.wanted.own.all.is_empty() && !fits.iter().any(keeps)
    }

    /// What keeps the stated error beyond the budget: the cheapest of the formulas that cost more; else
    /// what comes nearest to it, of those and of the fits within the budget.
    fn nearest(&self, fits: &[Fit], dear: Vec<Hypothesis>, memo: &Memo) -> Result<String, FitStageError> {
        let Wanted { emission, safe_range, .. } = self.wanted;
        let limit = emission.max_error.unwrap_or(f64::INFINITY);
        let prices = dear.iter().map(|h| emission.price(h)).collect::<Result<Vec<f64>, _>>()?;
        let mut dear: Vec<(f64, Hypothesis)> = prices.into_iter().zip(dear).collect();
        dear.sort_by(|a, b| a.0.total_cmp(&b.0));
        // The function that is emitted of a fit may have operations more, which a budget does not count.
        let said = |fit: &Fit| {
            let ops = emission.call.ops(fit.approximation.cost.ops);
            (fit.approximation.certificate.max_abs, fit.approximation.name.clone(), ops)
        };
        let tried = fits.iter().map(said);
        let mut closest = tried.min_by(|a, b| a.0.total_cmp(&b.0));
        for (_, h) in &dear {
            let own = match self.of(h) {
                Ok(_) => None,
                Err(_) => Some(Prepared::new(Target::new(&self.wanted.spec, h)?, memo)?),
            };
            let prepared = own.as_ref().map_or_else(|| self.of(h), Ok)?;
            let search = Search { norm: Norm::Max, safe_range: safe_range.as_ref(), by: By::Us };
            let fit = match prepared.fit(h, &search) {
                Ok(fit) => fit,
                // A formula without a fit in this domain is passed over, as it is within a budget.
                Err(error) if error.is_unreliable() => continue,
                Err(error) => return Err(error),
            };
            let (error, name, ops) = said(&fit);
            if closest.as_ref().is_none_or(|(least, ..)| error < *least) {
                closest = Some((error, name, ops));
            }
            if error <= limit {
                let keeps = if limit.is_finite() { "keeps it" } else { "is the cheapest" };
                let cost = match emission.cost.filter(|_| emission.budget.is_some()) {
                    Some(vendor) => {
                        format!(
                            "at a cost of {:.1} by {}'s model",
                            emission.price_of_call(h)?,
                            vendor.title()
                        )
                    }
                    None => format!("with {ops} operations"),
                };
                return Ok(format!("{} {keeps}: error {error} {cost}", h.name()));
            }
        }
        let dear = |ops: u32| self.wanted.max_ops.is_some_and(|most| ops > most);
        let to = |(error, name, ops)| match dear(ops) {
            true => format!(" to {error} and max_ops to {ops}, which {name} has"),
            false => format!(" to {error}, which {name} has with {ops} operations"),
        };
        Ok(format!(
            "no formula of the catalogue keeps it in this region: raise max_error{}",
            closest.map(to).unwrap_or_default()
        ))
    }

    /// Marks the emitted fit to take.
    fn recommend(&self, fits: &mut [Fit]) {
        let Wanted { emission, norms, max_ops, .. } = self.wanted;
        if let Some(best) = emission.recommended(fits, norms, *max_ops) {
            fits[best].recommended = true;
        }
    }

    /// Leaves those emitted that the scene asks for, each by the name of its role and with the
    /// arguments that the scene asks for.
    fn pick(&self, fits: &mut [Fit]) -> Result<(), FitStageError> {
        let Wanted { emission, norms, max_ops, .. } = self.wanted;
        let is_named = self.wanted.own.names(self.wanted.formulas());
        let Some(picked) = emission.picked(fits, (norms, *max_ops), is_named) else { return Ok(()) };
        fits.iter_mut().for_each(|fit| fit.emitted = false);
        for (index, name) in picked {
            let original = &fits[index].hypothesis;
            let called = emission.called(original, &name, &self.wanted.spec)?;
            fits[index] = self.of(original)?.called(&fits[index], called)?;
        }
        Ok(())
    }
}

/// The samples of a target, which a formula needs.
fn among<'a>(
    prepared: &'a [Prepared<'a>],
    target: &Target,
    formula: &Hypothesis,
) -> Result<&'a Prepared<'a>, FitStageError> {
    let found = prepared.iter().find(|prepared| prepared.target == *target);
    found.ok_or_else(|| FitStageError::Unprepared { hypothesis: formula.file().to_string() })
}

/// A formula and the norm of its fit.
type Job = (Hypothesis, Norm);

/// Jobs and what became of them.
type Results = (Vec<Job>, Vec<Result<Fit, FitStageError>>);

/// Formulas that are fitted side by side where a search through them may end: the number is fixed,
/// since what is found must not depend on the machine.
const TOGETHER: usize = 4;

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
            Err(error) if error.is_unreliable() => dropped.push(Dropped {
                hypothesis: hypothesis.name().to_string(),
                norm: norm.name(),
                reason: error.reason(),
            }),
            Err(error) => return Err(error),
        }
    }
    Ok(fits)
}
