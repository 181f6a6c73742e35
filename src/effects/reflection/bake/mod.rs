//! Jobs to fits of the normalisation and tables of E, A and B.

mod code;
mod emit;
mod findings;
mod fits;
mod pictures;
mod tables;

use super::FitJob;
use super::demand::parted;
use crate::approximate::FitSet;
use crate::data::Use;
use crate::effects::context::Context;
use crate::effects::table::TableJob;
use crate::effects::{BakeError, Called, Made};
pub use tables::BakedTable;
pub(crate) use tables::measured_again;

/// Bakes the effect.
pub(super) fn bake(called: &Called, context: &Context) -> Result<Made, BakeError> {
    // Fits first: a hypothesis that is refused must not cost the tables.
    let (jobs, fit) = parted(&called.work);
    let FitSet { fits, dropped } = match fit {
        Some(job) => fits::bake_fits(job, &FitJob::of(context.scene, job), context)?,
        None => FitSet { fits: Vec::new(), dropped: Vec::new() },
    };
    let jobs = TableJob::all(context.scene, jobs)?;
    let (tables, broken) = tables::bake_tables(&jobs, context)?;
    let (measured, metric) = findings::measured(&tables, &fits);
    let mut made = Made::new(called, measured, metric);
    if let Some(job) = fit {
        made.promised(&job.promises, &fits, "fit", Use::Normalisation);
    }
    made.broken.extend(broken);
    emit::tables(&tables, context, &mut made.part)?;
    context.progress.stage("report of reflection");
    let region = fit.map(|job| job.region(context.scene.alpha)).transpose()?;
    let findings = findings::findings(&made.part.finding, region, &tables, (&fits, &dropped), context)?;
    made.findings(&findings)?;
    made.code(|language| code::in_language(language, &tables, &fits))?;
    made.tables = tables;
    made.fits(context, (fits, dropped), |_, _, entry| entry);
    Ok(made)
}
