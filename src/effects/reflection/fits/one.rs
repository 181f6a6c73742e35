//! One hypothesis in one norm, and one published formula.

use super::certified::certified;
use super::{Fit, FitSpec, FitStageError};
use crate::approximate::{Entry, Region, Searched, formula, searched};
use crate::data::{Norm, Source};
use crate::effects::reflection::samples::Data;
use lobefit_shade::{Domain, Hypothesis, ShadeError};

/// The box of inputs, alpha following from roughness.
fn domain(region: &Region) -> Result<Domain, ShadeError> {
    let ([r0, r1], [m0, m1]) = (region.roughness, region.mu);
    Domain::new(&[("roughness", r0, r1), ("mu", m0, m1)])?.with_derived(
        "alpha",
        "roughness",
        region.alpha_map.power(),
    )
}

/// The same, measured.
pub fn fit_one(
    spec: &FitSpec,
    hypothesis: &Hypothesis,
    norm: Norm,
    data: &dyn Data,
) -> Result<Fit, FitStageError> {
    let found = searched(hypothesis, norm, &data.samples(hypothesis, norm)?, &domain(&spec.region)?)?;
    let Searched { hypothesis, coefficients, termination } = found;
    let form = formula(&hypothesis, &coefficients, norm.name());
    let approximation = certified(spec, &hypothesis, form, Source::Fitted, data)?;
    Ok(Fit {
        approximation,
        hypothesis,
        termination: Some(termination),
        emitted: true,
        wraps: None,
        safe: None,
    })
}

/// A published formula with its constants, measured like ours.
pub fn published(
    spec: &FitSpec,
    entry: &Entry,
    emitted: bool,
    data: &dyn Data,
) -> Result<Fit, FitStageError> {
    let hypothesis = Hypothesis::parse(entry.file, entry.source)?;
    let source = Source::Published(entry.publication.unwrap_or_default().to_string());
    let form = formula(&hypothesis, &[], "published");
    let approximation = certified(spec, &hypothesis, form, source, data)?;
    let affordable = spec.max_ops.is_none_or(|most| approximation.cost.ops <= most);
    Ok(Fit {
        approximation,
        hypothesis,
        termination: None,
        emitted: emitted && affordable,
        wraps: None,
        safe: None,
    })
}
