//! What the scene's probes want of their lookups.

use std::collections::BTreeSet;

use super::{HYPOTHESES, PUBLISHED};
use crate::approximate::Formulas;
use crate::data::{MipChain, Pick, ProbeLookup};
use crate::effects::JobSummary;
use crate::effects::demand::{Demand, Job, Span};
use crate::scene::{Probe, Scene};
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::footprint;

/// Narrowest range of ratios of a job: its ends are this factor apart, a choice as the narrowest
/// range of roughness is.
const RHO_FACTOR_MIN: f64 = 1.01;

/// Seconds of the truths of the fits and of their grid on one core, and of one of the fits with its
/// total variation there.
const TRUTH_S: f64 = 0.35;
const FIT_S: f64 = 0.02;

/// What the probes of one job want: the lobe that their chains are prefiltered with, their
/// different chains and lookups.
#[derive(Clone, Debug, PartialEq)]
pub struct Lobe {
    /// The lobe.
    pub kernel: Kernel,
    /// The different chains of levels, in the order of the probes.
    pub chains: Vec<MipChain>,
    /// Whether the width and the functions of levels are called: by the probes without lookups, or
    /// by who compares.
    pub width: bool,
    /// The different lookups, with the chain of the probe that they fetch from, in the order of the
    /// probes.
    pub lookups: Vec<(ProbeLookup, Option<MipChain>)>,
}

/// Probes that are looked up with a rough lobe: place in the scene, probe, roughness range.
fn looked_up(scene: &Scene) -> impl Iterator<Item = (usize, &Probe, [f64; 2])> {
    let probes = scene.probes.iter().enumerate();
    probes.filter_map(|(i, probe)| Some((i, probe, probe.rough_range(scene.alpha)?)))
}

/// A demand for each of them; jobs by the lobe of their chains, in its order.
pub(super) fn demands(scene: &Scene) -> Vec<Demand> {
    let kernels: BTreeSet<&Kernel> = looked_up(scene).map(|(_, probe, _)| &probe.kernel).collect();
    let rank = |probe: &Probe| kernels.iter().take_while(|kernel| **kernel < &probe.kernel).count();
    looked_up(scene).map(|(of, probe, range)| demand(scene, (of, probe), rank(probe), range)).collect()
}

fn demand(scene: &Scene, (of, probe): (usize, &Probe), rank: usize, range: [f64; 2]) -> Demand {
    let roughness = Span::roughness(range, scene.alpha);
    let rho = Span::by_ratio(probe.rho, RHO_FACTOR_MIN, footprint::RHO);
    let mips = probe.mips.as_ref().map_or_else(String::new, |chain| format!("; {}", chain.text()));
    let (name, kernel) = (&probe.name, probe.kernel.word());
    let ranges = format!("roughness {}, rho {}{mips}", roughness.text(), rho.text());
    Demand {
        job: format!("parallax-{}", probe.kernel.name()).into(),
        rank,
        of,
        name: name.clone(),
        field: format!("probes[{of}]"),
        because: format!("{name}: probe prefiltered with the {kernel} lobe ({ranges})"),
        spans: vec![("rho", rho), ("roughness", roughness)],
        goals: probe.goals.clone(),
        ..Demand::default()
    }
}

/// That the probes of a scene in which none calls for it are smooth; none where there are none.
pub(super) fn smooth(scene: &Scene) -> Option<String> {
    let first = scene.probes.first()?;
    let more = scene.probes.len() - 1;
    let (of, stay) = match more {
        0 => (format!("`{}`", first.name), "stays"),
        _ => (format!("`{}` and {more} more", first.name), "stay"),
    };
    Some(format!("{of} {stay} below alpha 0.0001, which is smooth"))
}

/// What the probes of a job want; `None` of a job without probes.
pub(super) fn wanted(scene: &Scene, job: &Job) -> Option<Lobe> {
    let probes: Vec<&Probe> = job.demands.iter().filter_map(|demand| scene.probes.get(demand.of)).collect();
    let width = scene.output.pick != Pick::Best || probes.iter().any(|probe| probe.lookups.is_empty());
    let kernel = probes.first()?.kernel.clone();
    let mut lobe = Lobe { kernel, width, chains: Vec::new(), lookups: Vec::new() };
    for probe in probes {
        let new = probe.mips.clone().filter(|chain| !lobe.chains.contains(chain));
        lobe.chains.extend(new);
        for lookup in probe.lookups.iter().map(|lookup| (*lookup, probe.mips.clone())) {
            if !lobe.lookups.contains(&lookup) {
                lobe.lookups.push(lookup);
            }
        }
    }
    Some(lobe)
}

/// What all probes of a scene want, by lobe.
pub fn lobes(scene: &Scene) -> Vec<Lobe> {
    crate::effects::demand::merged(demands(scene)).iter().filter_map(|job| wanted(scene, job)).collect()
}

/// What a plan says of a job.
pub(super) fn summary(scene: &Scene, job: &Job) -> Option<JobSummary> {
    let lobe = wanted(scene, job)?;
    let chains = match if lobe.width { lobe.chains.len() } else { 0 } {
        0 => String::new(),
        1 => ", and functions of the level of a chain".into(),
        n => format!(", and functions of the level of {n} chains"),
    };
    let lookups = match lobe.lookups.len() {
        0 => String::new(),
        1 => ", and a lookup".into(),
        n => format!(", and {n} lookups"),
    };
    let fitted = match lobe.lookups.iter().filter(|(lookup, _)| lookup.is_fitted()).count() {
        0 => String::new(),
        n if n == lobe.lookups.len() => " of the lobe fitted to GGX".into(),
        n => format!(", {n} of the lobe fitted to GGX"),
    };
    let of = format!("the width of a fetch from a {} chain", lobe.kernel.name());
    let fits = HYPOTHESES.len() * job.goals.norms.len() + PUBLISHED.len();
    let summary = JobSummary::fits(job, &of, TRUTH_S + fits as f64 * FIT_S);
    let mut summary = summary.doubting(job, Formulas::of(&HYPOTHESES));
    summary.recommended = Some("the most accurate".into());
    summary.approximation += &format!("{chains}{lookups}{fitted}");
    Some(summary)
}
