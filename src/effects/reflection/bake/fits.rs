//! The fit job to measured fits.

use crate::approximate::FitSet;
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::effects::demand::Job;
use crate::effects::reflection::{FitJob, FitSpec, fit_all};

/// Fits all that the job asks for.
pub fn bake_fits(job: &Job, wants: &FitJob, context: &Context) -> Result<FitSet, BakeError> {
    context.progress.stage("fits");
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
