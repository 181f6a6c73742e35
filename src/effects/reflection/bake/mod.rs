//! Jobs to fits of the normalisation and tables of E, A and B.

mod findings;
mod pictures;

use super::demand::parted;
use super::{Dfg, FitJob, FitSpec, fit_all};
use crate::approximate::FitSet;
use crate::data::Use;
use crate::effects::code::functions;
use crate::effects::context::Context;
use crate::effects::demand::Job;
use crate::effects::table::{self, TableJob};
use crate::effects::{BakeError, Called, Made};

/// Bakes the effect.
pub(super) fn bake(called: &Called, context: &Context) -> Result<Made, BakeError> {
    // Fits first: a hypothesis that is refused must not cost the tables.
    let (jobs, fit) = parted(&called.work);
    let FitSet { fits, dropped } = match fit {
        Some(job) => bake_fits(job, context)?,
        None => FitSet { fits: Vec::new(), dropped: Vec::new() },
    };
    let jobs = TableJob::all(context.scene, jobs)?;
    let (tables, broken) = table::bake(&Dfg, &jobs, context)?;
    let (measured, metric) = findings::measured(&tables, &fits);
    let mut made = Made::new(called, measured, metric);
    if let Some(job) = fit {
        made.promised(&job.promises, &fits, "fit", Use::NORMALISATION);
    }
    made.broken.extend(broken);
    made.code(|language| functions(language, &fits))?;
    made.tables(context, tables)?;
    context.progress.stage("report of reflection");
    let region = fit.map(|job| job.region(context.scene.alpha)).transpose()?;
    let findings = findings::findings(&made, region, (&fits, &dropped), context)?;
    made.findings(&findings)?;
    made.fits(context, (fits, dropped), |_, _, entry| entry);
    Ok(made)
}

/// Fits all that the job asks for.
fn bake_fits(job: &Job, context: &Context) -> Result<FitSet, BakeError> {
    context.progress.stage("fits");
    let wants = FitJob::of(context.scene, job);
    let spec = FitSpec {
        smith: context.scene.smith,
        region: job.region(context.scene.alpha)?,
        max_ops: job.goals.max_ops,
        norms: job.goals.norms.clone(),
        average: wants.average,
        blend: wants.blend,
        hypotheses: context.hypotheses.iter().map(|h| (h.file.clone(), h.source.clone())).collect(),
    };
    Ok(fit_all(&spec, &context.counter)?)
}
