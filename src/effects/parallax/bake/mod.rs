//! Jobs to fits of the width of a fetch, one set for each lobe that chains are prefiltered with.

mod code;
mod entries;
mod findings;
mod lookups;

use std::collections::BTreeMap;

use super::{Grid, LevelFunction, ParallaxSpec, Variation, bias, demand, fit_all, of_chain, variations};
use crate::approximate::{Dropped, Emission, Fit, FitSet};
use crate::data::{Arguments, MipChain, Pick, Source};
use crate::effects::context::Context;
use crate::effects::demand::{Caller, Demand, Job, Promise};
use crate::effects::{BakeError, Called, Limited, Made};
use crate::scene::Scene;
use lobefit_shade::code::Float;
use lobefit_shade::round_up;
use lobefit_truth::quantity::footprint;

/// Roughnesses and ratios of the grid on which total variation is measured, the ends of both among
/// them.
const GRID: [usize; 2] = [19, 29];

/// The emitted width of a fetch, by its role. It takes alpha, since alpha is what it returns. The
/// scene's limit is on the total variation, which is measured afterwards: the most accurate width
/// within the budget is taken.
const WIDTH: &str = "parallax_width";

/// The formula that lookups have in them.
const FLOW: &str = "parallax_1.wgsl";

/// What was made for the chains of one kind of lobe.
struct Lobe<'a> {
    scene: &'a Scene,
    job: &'a Job,
    wants: demand::Lobe,
    spec: ParallaxSpec,
    fits: Vec<Fit>,
    dropped: Vec<Dropped>,
    /// Where no width is within the limits: what is, in words.
    nearest: Option<String>,
    grid: Grid,
    /// Of each of the fits.
    variations: Vec<Variation>,
    /// Of the best width in every cell.
    least: Variation,
    /// Of the chains of levels.
    functions: Vec<LevelFunction>,
    /// Lookups through proxies.
    lookups: Vec<lookups::Lookup>,
}

/// Bakes the effect.
pub(super) fn bake(called: &Called, context: &Context) -> Result<Made, BakeError> {
    context.progress.stage("fits of lookups");
    refuse_saturated(context.scene)?;
    let wants = called.work.iter().map(|job| {
        let lacks = || BakeError::Internal(format!("{}: no probe", job.name));
        Ok((job, demand::wanted(context.scene, job).ok_or_else(lacks)?))
    });
    let wants: Vec<(&Job, demand::Lobe)> = wants.collect::<Result<_, BakeError>>()?;
    let identifiers = identifiers(wants.iter().flat_map(|(_, lobe)| &lobe.chains));
    let fitted = wants.into_iter().map(|(job, wants)| Lobe::fitted(job, wants, &identifiers, context));
    let mut lobes: Vec<Lobe> = fitted.collect::<Result<_, _>>()?;
    let least = |lobe: &Lobe| {
        if lobe.wants.width { Some(lobe.least_variation(None)?.1) } else { lobe.flow()?.1.max() }
    };
    let worst = lobes.iter().filter_map(least).reduce(f64::max);
    let mut made =
        Made::new(called, worst, "largest total variation of the best fit, where a fetch is not saturated");
    for lobe in &mut lobes {
        made.broken.extend(lobe.job.promises.iter().filter_map(|promise| lobe.unkept(promise)));
        made.broken.extend(lobe.without_lookups());
        let nearest = lobe.nearest.as_ref().filter(|_| lobe.wants.width);
        made.broken.extend(nearest.map(|nearest| FitSet::unkept(WIDTH, nearest)));
        if !lobe.wants.width {
            let Lobe { fits, functions, lookups, .. } = lobe;
            fits.iter_mut().for_each(|fit| fit.emitted = false);
            functions.retain(|one| lookups.iter().any(|l| l.wanted.called() == Some(one.hypothesis.name())));
        }
        entries::enter(lobe, context.scene.alpha.name(), &mut made.part.entries);
    }
    if !made.broken.is_empty() {
        return Ok(made);
    }
    made.limited = Some(limited(&lobes));
    if context.reports(called.effect) {
        for lobe in &lobes {
            made.beside.extend(lookups::beside(lobe, &made.part.entries.lookups, &identifiers)?);
        }
        let findings = findings::findings(&made.part.finding, &lobes, context)?;
        made.page(super::page::page(&findings)?, &findings)?;
    }
    made.code(context, |language| code::in_language(language, &lobes))?;
    for lobe in &lobes {
        let calling = |demand: &&Demand| context.scene.output.pick != Pick::Best || !lobe.looks_up(demand);
        let callers: Vec<Caller> = lobe.job.demands.iter().filter(calling).map(Demand::caller).collect();
        for fit in lobe.fits.iter().filter(|fit| fit.emitted) {
            let price = context.scene.output.cost.map(|_| fit.price);
            made.called_by(callers.clone(), fit.hypothesis.name(), (&fit.approximation, price), None);
        }
        made.part.entries.calls.extend(lobe.lookups.iter().flat_map(|lookup| lookup.calls(lobe)));
    }
    for lobe in lobes {
        let set = (lobe.fits.clone(), lobe.dropped.clone());
        made.fits(context, set, |i, _, entry| entries::fetching(&lobe, i, entry))?;
    }
    Ok(made)
}

/// What limits of probes are on. A published formula is measured for every lobe: the first result
/// stands.
fn limited(lobes: &[Lobe]) -> Limited {
    let mut errors = BTreeMap::new();
    for (fit, variation) in lobes.iter().flat_map(|lobe| lobe.measured()) {
        if let Some(max) = variation.max() {
            errors.entry(fit.approximation.name.clone()).or_insert(round_up(max, 4));
        }
    }
    Limited { metric: "total variation of the width".into(), errors }
}

/// A probe whose every fetch is saturated has nothing to fit. That of the smallest ratio at the
/// smallest width is the last to saturate: the best width grows with both.
fn refuse_saturated(scene: &Scene) -> Result<(), BakeError> {
    for (i, probe) in scene.probes.iter().enumerate() {
        let Some([lowest, _]) = probe.rough_range(scene.alpha) else { continue };
        let (_, saturated) = footprint::best(&probe.kernel, scene.alpha.alpha(lowest), probe.rho[0])?;
        if saturated {
            let message = "every fetch is saturated there: the widest lobe is too narrow for the smallest ratio at the smallest \
                           roughness; begin at a smaller ratio or roughness";
            return Err(BakeError::Scene { field: format!("probes[{i}].rho"), message: message.into() });
        }
    }
    Ok(())
}

/// The different chains of all jobs, with what tells each from the others in the names of its
/// functions.
fn identifiers<'a>(chains: impl Iterator<Item = &'a MipChain>) -> Vec<(MipChain, String)> {
    let mut known: Vec<(MipChain, String)> = Vec::new();
    for chain in chains {
        if known.iter().any(|(k, _)| k == chain) {
            continue;
        }
        let name = match chain {
            MipChain::Mapped { map, count } => format!("{}_{count}", map.identifier()),
            MipChain::Given(levels) => {
                let before = known.iter().filter(|(k, _)| matches!(k, MipChain::Given(_))).count();
                match before {
                    0 => format!("levels_{}", levels.len()),
                    n => format!("levels_{}_{}", levels.len(), n + 1),
                }
            }
        };
        known.push((chain.clone(), name));
    }
    known
}

impl<'a> Lobe<'a> {
    fn fitted(
        job: &'a Job,
        wants: demand::Lobe,
        identifiers: &[(MipChain, String)],
        context: &Context<'a>,
    ) -> Result<Lobe<'a>, BakeError> {
        let own = job.emission(context.scene, WIDTH);
        let spec = ParallaxSpec {
            kernel: wants.kernel.clone(),
            alpha_map: context.scene.alpha,
            roughness: job.range("roughness")?,
            rho: job.range("rho")?,
            max_ops: job.goals.max_ops,
            norms: job.goals.norms.clone(),
            emission: Emission {
                arguments: Arguments::Alpha,
                // Places in a room are beyond f16.
                float: Float::F32,
                max_error: own.every_error,
                most_accurate: own.every_error.is_none(),
                ..own
            },
        };
        let FitSet { fits, dropped, nearest, .. } = fit_all(&spec, &context.memo)?;
        let grid = Grid::new(spec.kernel.clone(), spec.alpha_map, spec.roughness, spec.rho, GRID)?;
        context.memo.add(grid.cells.len());
        let variations = variations(&grid, &fits)?;
        let best: Vec<f64> = grid.cells.iter().map(|cell| cell.best).collect();
        let least = Variation::of(&grid, &best)?;
        let mut lobe = Lobe {
            scene: context.scene,
            job,
            wants,
            spec,
            fits,
            dropped,
            nearest,
            grid,
            variations,
            least,
            functions: Vec::new(),
            lookups: Vec::new(),
        };
        lobe.functions = lobe.levels(identifiers)?;
        lobe.lookups = lookups::of(&lobe, identifiers)?;
        Ok(lobe)
    }

    /// The functions of the chains, by the best fit; none where no fit is emitted.
    fn levels(&self, identifiers: &[(MipChain, String)]) -> Result<Vec<LevelFunction>, BakeError> {
        let Some(best) = self.best() else { return Ok(Vec::new()) };
        let mut functions = Vec::new();
        for (chain, identifier) in identifiers.iter().filter(|(chain, _)| self.wants.chains.contains(chain)) {
            functions.extend(of_chain(chain, identifier, self.spec.alpha_map, best, &self.grid)?);
        }
        functions.extend(bias(&self.wants.chains, self.spec.alpha_map, &self.grid)?);
        Ok(functions)
    }

    /// Each fit with its total variation.
    fn measured(&self) -> impl Iterator<Item = (&Fit, &Variation)> {
        self.fits.iter().zip(&self.variations)
    }

    /// The most accurate of the emitted fits, the cheapest of equals: the one that levels are
    /// adjusted by.
    fn best(&self) -> Option<&Fit> {
        let rank = |fit: &&Fit| (fit.approximation.certificate.max_abs, fit.approximation.cost.ops);
        let emitted = self.fits.iter().filter(|fit| fit.emitted);
        emitted.min_by(|a, b| rank(a).0.total_cmp(&rank(b).0).then(rank(a).1.cmp(&rank(b).1)))
    }

    /// The fit whose formula lookups have in them, with its total variation: the most accurate in
    /// any norm; none where it was dropped.
    fn flow(&self) -> Option<(&Fit, &Variation)> {
        let own = self
            .measured()
            .filter(|(fit, _)| fit.approximation.source == Source::Fitted && fit.hypothesis.file() == FLOW);
        let error = |fit: &Fit| fit.approximation.certificate.max_abs;
        own.min_by(|a, b| error(a.0).total_cmp(&error(b.0)))
    }

    /// The least of the largest total variations of the emitted fits of at most so many operations,
    /// with the fit.
    fn least_variation(&self, max_ops: Option<u32>) -> Option<(&Fit, f64)> {
        let affordable = |fit: &Fit| max_ops.is_none_or(|most| fit.approximation.cost.ops <= most);
        let emitted = self.measured().filter(|(fit, _)| fit.emitted && affordable(fit));
        emitted
            .filter_map(|(fit, variation)| Some((fit, variation.max()?)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Whether a probe has lookups.
    fn looks_up(&self, demand: &Demand) -> bool {
        self.scene.probes.get(demand.of).is_some_and(|probe| !probe.lookups.is_empty())
    }

    /// What says that lookups are wanted and the fit of their width is not there: every lookup is a
    /// promise.
    fn without_lookups(&self) -> Option<String> {
        if self.wants.lookups.is_empty() || self.flow().is_some() {
            return None;
        }
        let kernel = &self.spec.kernel;
        let wanting = self.job.demands.iter().filter(|demand| self.looks_up(demand));
        let names: Vec<String> =
            wanting.map(|demand| format!("{} ({}.lookups)", demand.name, demand.field)).collect();
        let limit = match (self.spec.max_ops, self.spec.emission.budget) {
            (Some(ops), _) => format!("raise max_ops, which is {ops}"),
            (None, Some(budget)) => format!("raise the budget, which is {budget}"),
            (None, None) => "widen the ranges of roughness and rho".into(),
        };
        Some(format!(
            "parallax of {} chains: no fit of the width of lookups, and so no lookup, wanted by {}: {limit}",
            kernel.name(),
            names.join(", ")
        ))
    }

    /// A promise that is not kept, in words.
    fn unkept(&self, promise: &Promise) -> Option<String> {
        let (kernel, wanted) = (self.spec.kernel.name(), promise.text());
        match self.least_variation(promise.max_ops) {
            None => Some(format!("parallax of {kernel} chains: no fit is that cheap: {wanted}")),
            Some((fit, max)) if max > promise.max_error => {
                let name = &fit.approximation.name;
                Some(format!(
                    "parallax of {kernel} chains: the best is {name} with total variation {max:.4}: {wanted}"
                ))
            }
            Some(_) => self.unkept_by_lookups(promise),
        }
    }

    /// The same of the fit that lookups take the width from.
    fn unkept_by_lookups(&self, promise: &Promise) -> Option<String> {
        let (fit, variation) = self.flow().filter(|_| !self.wants.lookups.is_empty())?;
        let max = variation.max().filter(|max| *max > promise.max_error)?;
        Some(format!(
            "parallax of {} chains: lookups take the width of {} with total variation {max:.4}: {}",
            self.spec.kernel.name(),
            fit.approximation.name,
            promise.text()
        ))
    }
}
