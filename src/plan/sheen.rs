//! The fits that the scene's sheen layers want together, and what a plan says of them.

use std::collections::BTreeMap;

use super::effect::{Effect, EffectName, JobSummary};
use super::job::{Limit, SheenJob};
use super::merge::{hull, promise, strictest, widened};
use super::reflection::range_text;
use super::work;
use crate::scene::{Material, Scene, Sheen};

/// Materials with a rough sheen: place in the scene, material, sheen, roughness range.
fn sheens(scene: &Scene) -> impl Iterator<Item = (usize, &Material, &Sheen, [f64; 2])> {
    let materials = scene.materials.iter().enumerate();
    materials.filter_map(|(i, m)| Some((i, m, m.sheen.as_ref()?, m.sheen_range(scene.alpha)?)))
}

/// The fits that they want together.
pub(super) fn job(scene: &Scene) -> Option<SheenJob> {
    let mut job: Option<SheenJob> = None;
    for (i, material, sheen, roughness) in sheens(scene) {
        let job = job.get_or_insert_with(|| SheenJob {
            alpha_map: scene.alpha,
            roughness,
            mu: scene.mu,
            max_ops: sheen.max_ops,
            max_error: None,
            promises: Vec::new(),
            norms: Vec::new(),
        });
        job.roughness = hull(job.roughness, roughness);
        job.max_ops = job.max_ops.zip(sheen.max_ops).map(|(a, b)| a.max(b));
        job.max_error = strictest(job.max_error, sheen.max_error);
        job.norms.extend(&sheen.norms);
        job.norms.sort();
        job.norms.dedup();
        if let Some(max_error) = sheen.max_error {
            let field = format!("materials[{i}].sheen.max_error");
            promise(
                &mut job.promises,
                sheen.max_ops,
                Limit { material: material.name.clone(), field, max_error },
            );
        }
    }
    if let Some(job) = &mut job {
        job.roughness = widened(job.roughness, scene.alpha);
    }
    job
}

/// The effect, which the job's materials call for.
pub(super) fn effect(scene: &Scene, job: &SheenJob) -> Effect {
    let because = sheens(scene).map(|(_, m, _, range)| {
        let roughness = range_text(range, widened(range, scene.alpha));
        format!("{}: {} with a sheen layer (roughness {roughness})", m.name, m.kind.name())
    });
    Effect::new(EffectName::Sheen, because.collect(), vec![summary(job)], work::REPORT_S)
}

fn summary(job: &SheenJob) -> JobSummary {
    let ops = job.max_ops.map_or_else(|| "any number of".into(), |n| format!("up to {n}"));
    let norms: Vec<&str> = job.norms.iter().map(|n| n.name()).collect();
    JobSummary {
        name: "sheen".into(),
        approximation: format!("fits of the sheen's albedo, {ops} operations, {}", norms.join(" and ")),
        ranges: BTreeMap::from([("mu", job.mu), ("roughness", job.roughness)]),
        bytes: 0,
        bytes_at_most: false,
        expected_error: job.max_error,
        seconds: work::sheen_seconds(job),
    }
}
