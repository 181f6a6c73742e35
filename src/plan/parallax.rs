//! The fits that the scene's probes want, and what a plan says of them.

use std::collections::{BTreeMap, BTreeSet};

use super::effect::{Effect, EffectName, JobSummary};
use super::job::{Limit, ParallaxJob};
use super::merge::{hull, promise, strictest, widened};
use super::reflection::range_text;
use super::work;
use crate::scene::{Probe, Scene};
use lobefit_truth::integrate::footprint;
use lobefit_truth::optics::kernel::Kernel;

/// Narrowest range of ratios of a job: its ends are this factor apart, a choice as that of roughness is.
const RHO_FACTOR_MIN: f64 = 1.01;

/// Probes that are looked up with a rough lobe: place in the scene, probe, roughness range.
fn looked_up(scene: &Scene) -> impl Iterator<Item = (usize, &Probe, [f64; 2])> {
    let probes = scene.probes.iter().enumerate();
    probes.filter_map(|(i, probe)| Some((i, probe, probe.rough_range(scene.alpha)?)))
}

/// The fits that they want, by the lobe of their chains in its order.
pub(super) fn jobs(scene: &Scene) -> Vec<ParallaxJob> {
    let kernels: BTreeSet<Kernel> = looked_up(scene).map(|(_, probe, _)| probe.kernel).collect();
    kernels.into_iter().filter_map(|kernel| job(scene, kernel)).collect()
}

fn job(scene: &Scene, kernel: Kernel) -> Option<ParallaxJob> {
    let mut job: Option<ParallaxJob> = None;
    for (index, probe, roughness) in looked_up(scene).filter(|(_, probe, _)| probe.kernel == kernel) {
        let job = job.get_or_insert_with(|| ParallaxJob {
            kernel,
            alpha_map: scene.alpha,
            roughness,
            rho: probe.rho,
            chains: Vec::new(),
            lookups: Vec::new(),
            max_ops: probe.max_ops,
            max_error: None,
            promises: Vec::new(),
            norms: Vec::new(),
        });
        job.roughness = hull(job.roughness, roughness);
        job.rho = hull(job.rho, probe.rho);
        job.max_ops = job.max_ops.zip(probe.max_ops).map(|(a, b)| a.max(b));
        job.max_error = strictest(job.max_error, probe.max_error);
        job.norms.extend(&probe.norms);
        job.norms.sort();
        job.norms.dedup();
        let new = probe.mips.clone().filter(|chain| !job.chains.contains(chain));
        job.chains.extend(new);
        for lookup in probe.lookups.iter().map(|lookup| (*lookup, probe.mips.clone())) {
            if !job.lookups.contains(&lookup) {
                job.lookups.push(lookup);
            }
        }
        if let Some(max_error) = probe.max_error {
            let field = format!("probes[{index}].max_error");
            let limit = Limit { material: probe.name.clone(), field, max_error };
            promise(&mut job.promises, probe.max_ops, limit);
        }
    }
    let mut job = job?;
    job.roughness = widened(job.roughness, scene.alpha);
    job.rho = widened_ratio(job.rho);
    Some(job)
}

/// The range, or where its ends are closer than [`RHO_FACTOR_MIN`], one of that factor about it inside the domain.
fn widened_ratio([lo, hi]: [f64; 2]) -> [f64; 2] {
    if hi >= RHO_FACTOR_MIN * lo {
        return [lo, hi];
    }
    let low = (lo / RHO_FACTOR_MIN.sqrt()).clamp(footprint::RHO[0], footprint::RHO[1] / RHO_FACTOR_MIN);
    [low.min(lo), (low * RHO_FACTOR_MIN).min(footprint::RHO[1]).max(hi)]
}

/// The effect, where a probe calls for it.
pub(super) fn effect(scene: &Scene, jobs: &[ParallaxJob]) -> Option<Effect> {
    if jobs.is_empty() {
        return None;
    }
    let because = looked_up(scene).map(|(_, probe, range)| because(scene, probe, range)).collect();
    let summaries = jobs.iter().map(summary).collect();
    Some(Effect::new(EffectName::Parallax, because, summaries, work::PARALLAX_REPORT_S))
}

fn because(scene: &Scene, probe: &Probe, range: [f64; 2]) -> String {
    let roughness = range_text(range, widened(range, scene.alpha));
    let rho = range_text(probe.rho, widened_ratio(probe.rho));
    let mips = probe.mips.as_ref().map_or_else(String::new, |chain| format!("; {}", chain.text()));
    let (name, kernel) = (&probe.name, probe.kernel.word());
    format!("{name}: probe prefiltered with the {kernel} lobe (roughness {roughness}, rho {rho}{mips})")
}

fn summary(job: &ParallaxJob) -> JobSummary {
    let ops = job.max_ops.map_or_else(|| "any number of".into(), |n| format!("up to {n}"));
    let norms: Vec<&str> = job.norms.iter().map(|n| n.name()).collect();
    let kernel = job.kernel.name();
    let chains = match job.chains.len() {
        0 => String::new(),
        1 => ", and functions of the level of a chain".into(),
        n => format!(", and functions of the level of {n} chains"),
    };
    let lookups = match job.lookups.len() {
        0 => String::new(),
        1 => ", and a lookup".into(),
        n => format!(", and {n} lookups"),
    };
    let fitted = match job.lookups.iter().filter(|(lookup, _)| lookup.is_fitted()).count() {
        0 => String::new(),
        n if n == job.lookups.len() => " of the lobe fitted to GGX".into(),
        n => format!(", {n} of the lobe fitted to GGX"),
    };
    JobSummary {
        name: format!("parallax-{kernel}"),
        approximation: format!(
            "fits of the width of a fetch from a {kernel} chain, {ops} operations, {}{chains}{lookups}{fitted}",
            norms.join(" and ")
        ),
        ranges: BTreeMap::from([("rho", job.rho), ("roughness", job.roughness)]),
        bytes: 0,
        bytes_at_most: false,
        expected_error: job.max_error,
        seconds: work::parallax_seconds(job),
    }
}
