//! The part of the effect `parallax`: fits of the width of a fetch, one set for each lobe that chains are prefiltered with.

mod code;
mod entries;
mod findings;
mod lookups;

use crate::approximate::{Dropped, Fit, FitSet};
use crate::bake::Baked;
use crate::bake::Part;
use crate::data::MipChain;
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::effects::parallax::{
    Grid, LevelFunction, ParallaxSpec, Variation, bias, fit_all, of_chain, variations,
};
use crate::emit::manifest::canonical;
use crate::emit::manifest::{Entries, Report};
use crate::plan::{Effect, FitPromise, ParallaxJob};
use crate::report;
use crate::scene::Scene;
use crate::store::Files;

const EFFECT: &str = "parallax";

/// Roughnesses and ratios of the grid on which total variation is measured, the ends of both among them.
const GRID: [usize; 2] = [19, 29];

/// What was made for the chains of one kind of lobe.
struct Lobe<'a> {
    job: &'a ParallaxJob,
    fits: Vec<Fit>,
    dropped: Vec<Dropped>,
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

/// Bakes the effect; its fits and hypotheses left out go into `baked` as well.
pub fn part(
    scene: &Scene,
    jobs: &[ParallaxJob],
    effect: &Effect,
    baked: &mut Baked,
    context: &mut Context,
) -> Result<Part, BakeError> {
    context.progress.stage("fits of lookups");
    let identifiers = identifiers(jobs);
    let mut lobes = Vec::new();
    for job in jobs {
        let lobe = Lobe::fitted(job, &identifiers, context)?;
        context.broken.extend(job.promises.iter().filter_map(|promise| lobe.unkept(promise)));
        context.broken.extend(lobe.without_lookups(scene));
        lobes.push(lobe);
    }
    let (mut entries, mut files) = (Entries::default(), Files::new());
    for lobe in &lobes {
        entries::enter(lobe, scene, &mut entries)?;
    }
    context.progress.stage("report of parallax");
    let findings = findings::findings(scene, &lobes, effect, context)?;
    for file in report::files(EFFECT, &super::page::page(&findings)?, &findings)? {
        entries.reports.push(canonical(&Report { effect: Some(EFFECT), file: file.path.clone() })?);
        files.insert(file.path, file.bytes);
    }
    let code = code::section(&lobes)?;
    for lobe in lobes {
        baked.take(lobe.fits, lobe.dropped);
    }
    Ok(Part { effect: effect.effect, finding: findings.effect, entries, code, files })
}

/// The different chains of all jobs, with what tells each from the others in the names of its functions.
fn identifiers(jobs: &[ParallaxJob]) -> Vec<(MipChain, String)> {
    let mut known: Vec<(MipChain, String)> = Vec::new();
    for chain in jobs.iter().flat_map(|job| &job.chains) {
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
        job: &'a ParallaxJob,
        identifiers: &[(MipChain, String)],
        context: &Context,
    ) -> Result<Lobe<'a>, BakeError> {
        let spec = ParallaxSpec {
            kernel: job.kernel,
            alpha_map: job.alpha_map,
            roughness: job.roughness,
            rho: job.rho,
            max_ops: job.max_ops,
            norms: job.norms.clone(),
        };
        let FitSet { fits, dropped } = fit_all(&spec, &context.counter)?;
        let grid = Grid::new(job.kernel, job.alpha_map, job.roughness, job.rho, GRID)?;
        context.counter.add(grid.cells.len());
        let variations = variations(&grid, &fits)?;
        let best: Vec<f64> = grid.cells.iter().map(|cell| cell.best).collect();
        let least = Variation::of(&grid, &best)?;
        let mut lobe =
            Lobe { job, fits, dropped, grid, variations, least, functions: Vec::new(), lookups: Vec::new() };
        lobe.functions = lobe.levels(identifiers)?;
        lobe.lookups = lookups::of(&lobe, identifiers)?;
        Ok(lobe)
    }

    /// The functions of the chains, by the best fit; none where no fit is emitted.
    fn levels(&self, identifiers: &[(MipChain, String)]) -> Result<Vec<LevelFunction>, BakeError> {
        let Some(best) = self.best() else { return Ok(Vec::new()) };
        let mut functions = Vec::new();
        for (chain, identifier) in identifiers.iter().filter(|(chain, _)| self.job.chains.contains(chain)) {
            functions.extend(of_chain(chain, identifier, self.job.alpha_map, best, &self.grid)?);
        }
        functions.extend(bias(&self.job.chains, self.job.alpha_map, &self.grid)?);
        Ok(functions)
    }

    /// Each fit with its total variation.
    fn measured(&self) -> impl Iterator<Item = (&Fit, &Variation)> {
        self.fits.iter().zip(&self.variations)
    }

    /// The most accurate of the emitted fits, the cheapest of equals: the one that levels are adjusted by.
    fn best(&self) -> Option<&Fit> {
        let rank = |fit: &&Fit| (fit.approximation.certificate.max_abs, fit.approximation.cost.ops);
        let emitted = self.fits.iter().filter(|fit| fit.emitted);
        emitted.min_by(|a, b| rank(a).0.total_cmp(&rank(b).0).then(rank(a).1.cmp(&rank(b).1)))
    }

    /// The least of the largest total variations of the emitted fits of at most so many operations, with the fit.
    fn least_variation(&self, max_ops: Option<u32>) -> Option<(&Fit, f64)> {
        let affordable = |fit: &Fit| max_ops.is_none_or(|most| fit.approximation.cost.ops <= most);
        let emitted = self.measured().filter(|(fit, _)| fit.emitted && affordable(fit));
        emitted
            .filter_map(|(fit, variation)| Some((fit, variation.max()?)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// What says that lookups are wanted and no fit is emitted that they could take the width from: every lookup is a promise.
    fn without_lookups(&self, scene: &Scene) -> Option<String> {
        if self.job.lookups.is_empty() || self.best().is_some() {
            return None;
        }
        let kernel = self.job.kernel;
        let probes = scene.probes.iter().enumerate();
        let wanting = probes.filter(|(_, probe)| probe.kernel == kernel && !probe.lookups.is_empty());
        let names: Vec<String> =
            wanting.map(|(i, probe)| format!("{} (probes[{i}].lookups)", probe.name)).collect();
        let limit = match self.job.max_ops {
            Some(ops) => format!("raise max_ops, {ops} operations by now"),
            None => "widen the ranges of roughness and rho".into(),
        };
        Some(format!(
            "parallax of {} chains: no fit of the width is emitted, and so no lookup, wanted by {}: {limit}",
            kernel.name(),
            names.join(", ")
        ))
    }

    /// A promise that is not kept, in words.
    fn unkept(&self, promise: &FitPromise) -> Option<String> {
        let kernel = self.job.kernel.name();
        let within = promise.max_ops.map_or_else(String::new, |ops| format!(" within {ops} operations"));
        let wanted = format!("max_error {}{within}, wanted by {}", promise.max_error, promise.wanted_by());
        match self.least_variation(promise.max_ops) {
            None => Some(format!("parallax of {kernel} chains: no fit is that cheap: {wanted}")),
            Some((fit, max)) if max > promise.max_error => {
                let name = &fit.approximation.name;
                Some(format!(
                    "parallax of {kernel} chains: the best is {name} with total variation {max:.4}: {wanted}"
                ))
            }
            Some(_) => None,
        }
    }
}
