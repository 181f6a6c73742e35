//! The part of an effect whose tables have three axes: `anisotropy` and `glass`.

mod azimuth;
mod emit;
mod findings;
mod furnaces;
mod grid;
mod readings;
mod tables;

use crate::bake::Baked;
use crate::bake::Part;
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::emit::manifest::canonical;
use crate::emit::manifest::{Entries, Report};
use crate::plan::{Effect, Plan, VolumeJob};
use crate::report;
use crate::scene::Scene;
use crate::store::Files;
pub use tables::BakedVolume;
pub(crate) use tables::measured_again;

/// Bakes the effect; its tables go into `baked` as well.
pub fn part(
    scene: &Scene,
    plan: &Plan,
    effect: &Effect,
    baked: &mut Baked,
    context: &mut Context,
) -> Result<Part, BakeError> {
    let jobs: Vec<&VolumeJob> =
        plan.volumes.iter().filter(|job| job.span.effect() == effect.effect).collect();
    let (tables, judges) = tables::bake(&jobs, context)?;
    let mut entries = Entries::default();
    let mut files = Files::new();
    let name = effect.effect.name();
    emit::tables(name, &tables, &scene.formats, context, &mut files, &mut entries)?;
    context.progress.stage(&format!("report of {name}"));
    let findings = findings::findings(scene, effect, &jobs, &tables, &judges, &entries, context)?;
    for file in report::files(name, &super::page::page(&findings)?, &findings)? {
        entries.reports.push(canonical(&Report { effect: Some(name), file: file.path.clone() })?);
        files.insert(file.path, file.bytes);
    }
    let code = emit::section(&tables);
    baked.volumes.extend(tables);
    Ok(Part { effect: effect.effect, finding: findings.effect, entries, code, files })
}
