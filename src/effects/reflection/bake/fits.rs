//! The fit job to measured fits.

use crate::approximate::{Fit, FitSet, Region};
use crate::data::Use;
use crate::effects::context::Context;
use crate::effects::reflection::{FitSpec, fit_all};
use crate::effects::{BakeError, UserHypothesis};
use crate::plan::{FitJob, FitPromise};

/// Fits all that the job asks for. A promise that no fit keeps is noted in the context.
pub fn bake_fits(
    job: &FitJob,
    hypotheses: &[UserHypothesis],
    context: &mut Context,
) -> Result<FitSet, BakeError> {
    context.progress.stage("fits");
    let spec = FitSpec {
        smith: job.smith,
        region: region(job),
        max_ops: job.max_ops,
        norms: job.norms.clone(),
        average: job.average,
        blend: job.blend,
        hypotheses: hypotheses.iter().map(|h| (h.file.clone(), h.source.clone())).collect(),
    };
    let set = fit_all(&spec, &context.counter)?;
    for promise in &job.promises {
        context.broken.extend(unkept(promise, &set.fits, "fit", Use::Normalisation));
    }
    Ok(set)
}

/// Where the fits of a job must hold.
pub fn region(job: &FitJob) -> Region {
    Region { roughness: job.roughness, mu: job.mu, alpha_map: job.alpha_map }
}

/// A sentence, after `what`, where no emitted fit for the use, of at most so many operations, is within the promised error.
pub fn unkept(promise: &FitPromise, fits: &[Fit], what: &str, used_as: Use) -> Option<String> {
    let emitted = fits.iter().filter(|f| f.emitted && f.wraps.is_none());
    let affordable = emitted
        .map(|f| &f.approximation)
        .filter(|a| a.used_as == used_as)
        .filter(|a| promise.max_ops.is_none_or(|most| a.cost.ops <= most));
    let best = affordable.min_by(|a, b| a.certificate.max_abs.total_cmp(&b.certificate.max_abs));
    let limit = match promise.max_ops {
        Some(ops) => format!("max_error {} within {ops} operations", promise.max_error),
        None => format!("max_error {}", promise.max_error),
    };
    let wanted = format!("{limit}, wanted by {}", promise.wanted_by());
    let (name, error) = match used_as {
        Use::Normalisation => ("normalisation", "furnace error"),
        _ => ("fit", "error"),
    };
    match best {
        None => Some(format!("{what}: no {name} is that cheap: {wanted}")),
        Some(a) if a.certificate.max_abs > promise.max_error => {
            Some(format!("{what}: the best is {} with {error} {}: {wanted}", a.name, a.certificate.max_abs))
        }
        Some(_) => None,
    }
}
