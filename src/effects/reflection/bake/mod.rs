//! The part of the effect `reflection`: fits of the normalisation, tables of E, A and B.

mod code;
mod findings;
mod fits;
mod pictures;
mod tables;

use crate::approximate::{Dropped, FitSet};
use crate::bake::Baked;
use crate::bake::Part;
use crate::data::{Container, Decode};
use crate::effects::containers::contained;
use crate::effects::context::Context;
use crate::effects::{BakeError, UserHypothesis};
use crate::emit::manifest::canonical;
use crate::emit::manifest::{Entries, FitEntry, FitLeftOut, LookupEntry, Report, TableEntry};
use crate::plan::{Effect, Plan};
use crate::report;
use crate::scene::Scene;
use crate::store::Files;
pub(in crate::effects) use code::section;
pub(in crate::effects) use findings::{Selected, left_out, selected};
pub(in crate::effects) use fits::unkept;
pub(in crate::effects) use pictures::{chosen, grazing};
pub use tables::BakedTable;
pub(crate) use tables::measured_again;

const EFFECT: &str = "reflection";

/// Bakes the effect; tables, fits and hypotheses left out go into `baked` as well.
pub fn part(
    scene: &Scene,
    plan: &Plan,
    effect: &Effect,
    hypotheses: &[UserHypothesis],
    baked: &mut Baked,
    context: &mut Context,
) -> Result<Part, BakeError> {
    // Fits first: a hypothesis that is refused must not cost the tables.
    let FitSet { fits, dropped } = match &plan.fit {
        Some(job) => fits::bake_fits(job, hypotheses, context)?,
        None => FitSet { fits: Vec::new(), dropped: Vec::new() },
    };
    let tables = tables::bake_tables(&plan.tables, context)?;
    let mut entries = Entries::default();
    let mut files = Files::new();
    emit_tables(&tables, &scene.formats, context, &mut files, &mut entries)?;
    for fit in fits.iter().filter(|f| f.emitted) {
        if let Some(entry) = FitEntry::new(EFFECT, scene.alpha.name(), &fit.approximation) {
            entries.fits.push(canonical(&entry)?);
        }
    }
    for left_out in &dropped {
        entries.fits_left_out.push(canonical(&left_out_fit(left_out))?);
    }
    context.progress.stage("report of reflection");
    let findings = findings::findings(scene, plan, effect, &tables, &fits, &dropped, context)?;
    for file in report::page(EFFECT, &findings)? {
        entries.reports.push(canonical(&Report { effect: Some(EFFECT), file: file.path.clone() })?);
        files.insert(file.path, file.bytes);
    }
    let code = section(&tables, &fits)?;
    let finding = findings.effects.into_iter().next();
    let finding = finding.ok_or_else(|| BakeError::Internal("findings without an effect".into()))?;
    baked.tables = tables;
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

fn emit_tables(
    tables: &[BakedTable],
    formats: &[Container],
    context: &Context,
    files: &mut Files,
    entries: &mut Entries,
) -> Result<(), BakeError> {
    for baked in tables {
        let Some(table) = baked.table() else { continue };
        let decode = Decode::of(baked.layout, baked.serves);
        let written =
            contained(table, decode, &baked.approximation.certificate, None, formats, context, files)?;
        let formulas = decode.formulas().iter().copied().collect();
        let entry = TableEntry::new(EFFECT, &baked.approximation, table, formulas, errors(baked));
        entries.tables.push(canonical(&entry.in_files(written))?);
    }
    Ok(())
}

fn errors(baked: &BakedTable) -> crate::emit::manifest::TableError {
    let entry = |e: &crate::effects::Deviation| LookupEntry { max: e.max, rms: e.rms, at: e.at.clone() };
    crate::emit::manifest::TableError {
        integration: baked.errors.integration,
        quantisation: baked.errors.quantisation.iter().fold(0.0, |worst, r| r.max.max(worst)),
        lookup: entry(&baked.errors.lookup),
        lookup_8_bit_weights: entry(&baked.errors.lookup_8_bit),
    }
}
