//! Floor 5: the main job. A plan becomes a bundle of files in memory, which `bake` writes and `check` compares: the same
//! scene gives the same bytes.

mod compare;
mod context;
mod findings;
mod fits;
mod includes;
mod names;
mod pictures;
mod recipe;
mod tables;

use crate::data::TableError;
use crate::effects::reflection::{Counter, Dropped, Fit, FitSet, FitStageError};
use crate::emit::exr::ExrError;
use crate::emit::manifest::{
    FitEntry, FitLeftOut, Include, LeftOut, LookupEntry, Manifest, SCHEMA_VERSION, TableEntry,
};
use crate::emit::{code, exr, header};
use crate::integrate::IntegrateError;
use crate::plan::{EffectName, Plan};
use crate::report::{self, ReportError};
use crate::scene::Scene;
use crate::store::{Files, MANIFEST};
pub use compare::{Difference, compare};
use context::Context;
pub use context::{Progress, Silent};
pub use recipe::{UserHypothesis, recipe};
pub use tables::BakedTable;

/// What a bake made.
#[derive(Debug)]
pub struct Baked {
    /// Contents by path.
    pub files: Files,
    /// Promises of the scene that were not kept, each a sentence.
    pub broken: Vec<String>,
    /// Truths that were integrated.
    pub truths: u64,
    /// Tables.
    pub tables: Vec<BakedTable>,
    /// Fits, and published formulas for comparison.
    pub fits: Vec<Fit>,
    /// Hypotheses of the catalogue that have no reliable fit in this scene.
    pub dropped: Vec<Dropped>,
}

/// Why a bake made nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BakeError {
    /// A hypothesis or a fit.
    #[error(transparent)]
    Fit(#[from] FitStageError),
    /// A table's shape or values.
    #[error(transparent)]
    Table(#[from] TableError),
    /// An image could not be encoded or decoded.
    #[error(transparent)]
    Exr(#[from] ExrError),
    /// A truth could not be integrated.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
    /// A function could not be printed.
    #[error(transparent)]
    Code(#[from] code::CodeError),
    /// The report refused its data.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A document could not be put into JSON.
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A hypothesis has the name of another function.
    #[error(
        "{file}: function `{function}` has, or leads to, the name of another emitted function; rename it"
    )]
    Name {
        /// The hypothesis' file.
        file: String,
        /// The name.
        function: String,
    },
    /// A hypothesis whose function cannot be called so in an emitted language.
    #[error("{file}: {reason}")]
    Word {
        /// The hypothesis' file.
        file: String,
        /// What the printer says.
        reason: String,
    },
    /// Tables that are planned and not made yet.
    #[error("{table}: this version plans tables of three axes and does not bake them")]
    Volume {
        /// The first of them.
        table: String,
    },
    /// A defect of this program.
    #[error("internal error: {0}")]
    Internal(String),
}

/// The effect of this version.
const EFFECT: &str = "reflection";

/// Bakes a plan. Nothing is integrated, fitted, emitted or reported that it does not call for.
///
/// Errors: a hypothesis that is refused, a search that does not end in a minimum, data that is not finite. A promise that is
/// not kept is no error here: it is told in [`Baked::broken`].
pub fn bake(
    scene: &Scene,
    plan: &Plan,
    hypotheses: &[UserHypothesis],
    progress: &dyn Progress,
) -> Result<Baked, BakeError> {
    if let Some(table) = plan.volumes.iter().flat_map(|job| &job.tables).next() {
        return Err(BakeError::Volume { table: table.name.clone() });
    }
    let recipe = recipe(scene, hypotheses)?;
    let mut context = Context { recipe, counter: Counter::default(), broken: Vec::new(), progress };
    names::check(hypotheses)?;
    // Fits first: a hypothesis that is refused must not cost the tables.
    let FitSet { fits, dropped } = match &plan.fit {
        Some(job) => fits::bake_fits(job, hypotheses, &mut context)?,
        None => FitSet { fits: Vec::new(), dropped: Vec::new() },
    };
    let tables = tables::bake_tables(&plan.tables, &mut context)?;
    let mut files = Files::new();
    let mut manifest = empty_manifest(plan, &context);
    emit_tables(&tables, &context, &mut files, &mut manifest)?;
    emit_includes(scene, plan, &tables, &fits, &context, &mut files, &mut manifest)?;
    context.progress.stage("report");
    manifest.fits_left_out = dropped.iter().map(left_out_fit).collect();
    let findings = findings::findings(scene, plan, &tables, &fits, &dropped, &context)?;
    for file in report::page(&findings)? {
        manifest.reports.push(crate::emit::manifest::Report { file: file.path.clone() });
        files.insert(file.path, file.bytes);
    }
    files.insert(MANIFEST.to_string(), manifest.bytes()?);
    Ok(Baked { files, broken: context.broken, truths: context.counter.total(), tables, fits, dropped })
}

fn empty_manifest(plan: &Plan, context: &Context) -> Manifest {
    let left_out = plan.left_out.iter();
    Manifest {
        schema_version: SCHEMA_VERSION,
        tool: context.recipe.tool.clone(),
        scene: context.recipe.scene.clone(),
        recipe: context.recipe.hash.clone(),
        tables: Vec::new(),
        fits: Vec::new(),
        fits_left_out: Vec::new(),
        includes: Vec::new(),
        reports: Vec::new(),
        left_out: left_out
            .map(|l| LeftOut { effect: l.effect.name().into(), reason: l.reason.clone() })
            .collect(),
    }
}

fn left_out_fit(dropped: &Dropped) -> FitLeftOut {
    FitLeftOut {
        hypothesis: dropped.hypothesis.clone(),
        norm: dropped.norm.into(),
        reason: dropped.reason.clone(),
    }
}

fn emit_tables(
    tables: &[BakedTable],
    context: &Context,
    files: &mut Files,
    manifest: &mut Manifest,
) -> Result<(), BakeError> {
    for baked in tables {
        let Some(table) = baked.table() else { continue };
        let decode = crate::effects::reflection::decode(baked.layout, baked.serves);
        let lines =
            [context.recipe.lines(), header::table_lines(table, decode, &baked.approximation.certificate)];
        let text = lines.concat().join("\n");
        let path = format!("tables/{}.exr", table.name);
        files.insert(path, exr::encode(table, &[("lobefit".to_string(), text)])?);
        let decode = decode.iter().copied().collect();
        manifest.tables.push(TableEntry::new(EFFECT, &baked.approximation, table, decode, errors(baked)));
    }
    Ok(())
}

fn errors(baked: &BakedTable) -> crate::emit::manifest::TableError {
    let entry = |e: &crate::effects::reflection::LookupError| LookupEntry {
        max: e.max,
        rms: e.rms,
        at: e.at.clone(),
    };
    crate::emit::manifest::TableError {
        integration: baked.errors.integration,
        quantisation: baked.errors.quantisation.iter().fold(0.0, |worst, r| r.max.max(worst)),
        lookup: entry(&baked.errors.lookup),
        lookup_8_bit_weights: entry(&baked.errors.lookup_8_bit),
    }
}

fn emit_includes(
    scene: &Scene,
    plan: &Plan,
    tables: &[BakedTable],
    fits: &[Fit],
    context: &Context,
    files: &mut Files,
    manifest: &mut Manifest,
) -> Result<(), BakeError> {
    if !plan.effects.iter().any(|e| e.effect == EffectName::Reflection) {
        return Ok(());
    }
    let lobe = (scene.smith, scene.alpha);
    let emitted = || fits.iter().filter(|f| f.emitted);
    for (language, path, text) in includes::includes(lobe, tables, fits, context)? {
        files.insert(path.to_string(), text.into_bytes());
        manifest.includes.push(Include { language, file: path.to_string() });
    }
    manifest.fits =
        emitted().filter_map(|f| FitEntry::new(EFFECT, scene.alpha.name(), &f.approximation)).collect();
    Ok(())
}
