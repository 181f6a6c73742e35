//! The fits that the scene's diffuse bases want, and what a plan says of them.

use std::collections::BTreeMap;

use super::effect::{Effect, EffectName, JobSummary};
use super::job::{CouplingJob, Limit};
use super::merge::{hull, promise, rough, strictest, widened};
use super::reflection::range_text;
use super::work;
use crate::scene::{Base, Material, Scene};
use lobefit_truth::integrate::coupling::Specular;

/// A diffuse base under a rough lobe.
struct Coupled<'a> {
    /// Place of the material in the scene.
    index: usize,
    material: &'a Material,
    base: &'a Base,
    /// Rough part of its roughness.
    roughness: [f64; 2],
    /// Hull of its colour channels.
    f0: [f64; 2],
}

/// Dielectrics with a rough lobe over a base that sends back light.
fn coupled(scene: &Scene) -> impl Iterator<Item = Coupled<'_>> {
    rough(scene).filter_map(|(index, material, roughness)| {
        let base = material.base.as_ref().filter(|base| !base.is_black())?;
        let [first, rest @ ..] = material.f0?.map(twelve);
        let f0 = rest.iter().fold([first; 2], |all, f0| hull(all, [*f0; 2]));
        Some(Coupled { index, material, base, roughness, f0 })
    })
}

/// A reflectance in twelve digits, without the rounding error of ((1.5 - 1)/(1.5 + 1))^2.
fn twelve(f0: f64) -> f64 {
    format!("{f0:.11e}").parse().unwrap_or(f0)
}

/// The fits that they want, by the specular lobe above them.
pub(super) fn jobs(scene: &Scene) -> Vec<CouplingJob> {
    Specular::ALL.into_iter().filter_map(|specular| job(scene, specular)).collect()
}

fn job(scene: &Scene, specular: Specular) -> Option<CouplingJob> {
    let mut job: Option<CouplingJob> = None;
    for one in coupled(scene).filter(|one| one.base.specular == specular) {
        let Coupled { index, material, base, roughness, f0 } = one;
        let job = job.get_or_insert_with(|| CouplingJob {
            specular,
            smith: scene.smith,
            alpha_map: scene.alpha,
            roughness,
            mu: scene.mu,
            f0,
            max_ops: base.max_ops,
            max_error: None,
            promises: Vec::new(),
            norms: Vec::new(),
        });
        job.roughness = hull(job.roughness, roughness);
        job.f0 = hull(job.f0, f0);
        job.max_ops = job.max_ops.zip(base.max_ops).map(|(a, b)| a.max(b));
        job.max_error = strictest(job.max_error, base.max_error);
        job.norms.extend(&base.norms);
        job.norms.sort();
        job.norms.dedup();
        if let Some(max_error) = base.max_error {
            let field = format!("materials[{index}].base.max_error");
            let limit = Limit { material: material.name.clone(), field, max_error };
            promise(&mut job.promises, base.max_ops, limit);
        }
    }
    let mut job = job?;
    job.roughness = widened(job.roughness, scene.alpha);
    Some(job)
}

/// The effect, where a dielectric calls for it.
pub(super) fn effect(scene: &Scene, jobs: &[CouplingJob]) -> Option<Effect> {
    if jobs.is_empty() {
        return None;
    }
    let because = coupled(scene).map(|one| because(scene, &one)).collect();
    let summaries = jobs.iter().map(summary).collect();
    Some(Effect::new(EffectName::DiffuseCoupling, because, summaries, work::REPORT_S))
}

fn because(scene: &Scene, one: &Coupled) -> String {
    let Coupled { material, base, roughness, .. } = one;
    let (name, kind, specular) = (&material.name, material.kind.name(), base.specular.name());
    let roughness = range_text(*roughness, widened(*roughness, scene.alpha));
    let ignored = if material.anisotropy[1] > 0.0 { "; its anisotropy is left out of them" } else { "" };
    format!(
        "{name}: {kind} with a diffuse base under a {specular} lobe (roughness {roughness}) wants fits{ignored}"
    )
}

fn summary(job: &CouplingJob) -> JobSummary {
    let ops = job.max_ops.map_or_else(|| "any number of".into(), |n| format!("up to {n}"));
    let norms: Vec<&str> = job.norms.iter().map(|n| n.name()).collect();
    let specular = job.specular.name();
    JobSummary {
        name: format!("coupling-{specular}"),
        approximation: format!(
            "fits of the coupling factor under a {specular} lobe, {ops} operations, {}",
            norms.join(" and ")
        ),
        ranges: BTreeMap::from([("f0", job.f0), ("mu", job.mu), ("roughness", job.roughness)]),
        bytes: 0,
        bytes_at_most: false,
        expected_error: job.max_error,
        seconds: work::coupling_seconds(job),
    }
}
