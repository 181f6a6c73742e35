//! The part of the effect `sheen`: fits of its albedo.

use super::{SheenSpec, fit_all};
use crate::approximate::{Dropped, FitSet, Region};
use crate::bake::Baked;
use crate::bake::Part;
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::effects::reflection::bake::{section, unkept};
use crate::emit::manifest::canonical;
use crate::emit::manifest::{Entries, FitEntry, FitLeftOut, Report};
use crate::plan::{Effect, SheenJob};
use crate::report;
use crate::scene::Scene;
use crate::store::Files;

const EFFECT: &str = "sheen";

/// Bakes the effect; its fits and hypotheses left out go into `baked` as well.
pub fn part(
    scene: &Scene,
    job: &SheenJob,
    effect: &Effect,
    baked: &mut Baked,
    context: &mut Context,
) -> Result<Part, BakeError> {
    context.progress.stage("fits of the sheen");
    let region = Region { roughness: job.roughness, mu: job.mu, alpha_map: job.alpha_map };
    let spec = SheenSpec { region, max_ops: job.max_ops, norms: job.norms.clone() };
    let FitSet { fits, dropped } = fit_all(&spec, &context.counter)?;
    for promise in &job.promises {
        context.broken.extend(unkept(promise, &fits, "sheen", crate::data::Use::Value));
    }
    let (mut entries, mut files) = (Entries::default(), Files::new());
    for fit in fits.iter().filter(|f| f.emitted) {
        if let Some(entry) = FitEntry::new(EFFECT, scene.alpha.name(), &fit.approximation) {
            entries.fits.push(canonical(&entry)?);
        }
    }
    for left_out in &dropped {
        entries.fits_left_out.push(canonical(&left_out_fit(left_out))?);
    }
    context.progress.stage("report of sheen");
    let findings = super::page::findings(scene, &region, effect, &fits, &dropped, context)?;
    for file in report::page(EFFECT, &findings)? {
        entries.reports.push(canonical(&Report { effect: Some(EFFECT), file: file.path.clone() })?);
        files.insert(file.path, file.bytes);
    }
    let finding = findings.effects.into_iter().next();
    let finding = finding.ok_or_else(|| BakeError::Internal("findings without an effect".into()))?;
    let code = section(&[], &fits)?;
    baked.fits.extend(fits);
    baked.dropped.extend(dropped);
    Ok(Part { effect: effect.effect, finding, entries, code, files })
}

fn left_out_fit(dropped: &Dropped) -> FitLeftOut {
    FitLeftOut {
        effect: EFFECT,
        hypothesis: dropped.hypothesis.clone(),
        norm: dropped.norm.into(),
        reason: dropped.reason.clone(),
    }
}
