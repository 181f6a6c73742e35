//! Jobs of tables of three axes to measured tables.

mod azimuth;
mod emit;
mod findings;
mod furnaces;
mod grid;
mod readings;
mod tables;

use super::{TableJob, page};
use crate::effects::context::Context;
use crate::effects::{BakeError, Called, Made};
pub use tables::BakedVolume;
pub(crate) use tables::measured_again;

/// Bakes an effect whose tables have three axes.
pub(in crate::effects) fn bake(called: &Called, context: &Context) -> Result<Made, BakeError> {
    let jobs = TableJob::all(context.scene, &called.work)?;
    let tables::Baked { tables, judges, broken } = tables::bake(&jobs, context)?;
    let metric = "lookup error of the worst table in a layout of ours";
    let mut made = Made::new(called, findings::measured(&tables), metric);
    made.part.finding.expected_error = findings::expected(&jobs);
    made.broken = broken;
    emit::tables(&tables, context, &mut made.part)?;
    context.progress.stage(&format!("report of {}", called.effect));
    let findings = findings::findings(&made.part, &tables, &judges, context)?;
    made.page(&page::page(&findings)?, &findings)?;
    made.code(|language| emit::in_language(language, &tables))?;
    made.volumes = tables;
    Ok(made)
}
