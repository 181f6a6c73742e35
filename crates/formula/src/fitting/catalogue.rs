//! What the catalogue has for the same quantity, use and domain: fits of ours, and published
//! formulas.

use std::sync::Arc;

use serde_json::{Value, json};

use super::FittingError;
use lobefit::approximate::target::{Sampled, Target, TargetSpec};
use lobefit::approximate::{Emission, Formulas, Wanted, compared};
use lobefit::data::{AlphaMap, Approximation, Norm, Smith, Source, Vendor};
use lobefit::effects::catalogue;
use lobefit::report::words::operations;
use lobefit_shade::Hypothesis;

/// Something else that approximates the same for the same use.
#[derive(Clone, Debug)]
pub struct CatalogueFit {
    /// Name.
    pub name: String,
    /// Operations.
    pub ops: u32,
    /// Cost by the vendor's model, or the operations.
    pub price: f64,
    /// Largest error.
    pub max: f64,
    /// Root of the mean square error.
    pub rms: f64,
    /// Somebody else's constants; otherwise a fit of the catalogue.
    pub published: bool,
}

impl CatalogueFit {
    /// As in the documents for machines.
    pub(crate) fn entry(&self) -> Value {
        let CatalogueFit { name, ops, max, rms, published, .. } = self;
        json!({"name": name, "ops": ops, "max": max, "rms": rms, "published": published})
    }
}

/// What the catalogue has of at most `most` operations: its formulas fitted as a bake fits them,
/// for the largest error over the same domain, and published ones with their own constants; those of
/// the same target are measured at the points given. A formula without a reliable fit there is left
/// out; nothing where the conventions are others than the catalogue's.
pub(crate) fn fits(
    spec: &TargetSpec,
    (target, measured): (&Target, &Arc<Sampled>),
    most: u32,
    cost: Option<Vendor>,
) -> Result<Vec<CatalogueFit>, FittingError> {
    let usual = target.variant.smith.unwrap_or_default() == Smith::Correlated
        && target.alpha_map == AlphaMap::RoughnessSquared;
    if !usual {
        return Ok(Vec::new());
    }
    let known = target.inputs();
    let mut fits = Vec::new();
    for effect in catalogue() {
        let (mut own, mut published) = (Vec::new(), Vec::new());
        for entry in effect.formulas_for(target) {
            let hypothesis = Hypothesis::parse(entry.file, entry.source)?;
            let suits = hypothesis.inputs().iter().all(|input| known.contains(input));
            if suits && effect.operations(&hypothesis)? <= most {
                match hypothesis.parameters() {
                    [] => published.push(entry),
                    _ => own.push(*entry),
                }
            }
        }
        let wanted = Wanted {
            spec: spec.clone(),
            own: Formulas::of(&own),
            user: &[],
            published,
            norms: &[Norm::Max],
            max_ops: None,
            safe_range: effect.safe_range_for(target),
            emission: Emission { cost, ..Emission::default() },
        };
        for fit in compared(&wanted, (target, measured))? {
            let Approximation { name, source, certificate, .. } = &fit.approximation;
            fits.push(CatalogueFit {
                name: name.clone(),
                ops: effect.operations(&fit.hypothesis)?,
                price: fit.price,
                max: certificate.max_abs,
                rms: certificate.rms,
                published: matches!(source, Source::Published(_)),
            });
        }
    }
    Ok(fits)
}

/// What the catalogue has for the price of a formula of `ops` operations and largest error `max`:
/// its most accurate, in a sentence; `None` where it has nothing so cheap.
pub(super) fn beside(catalogue: &[CatalogueFit], ops: u32, max: f64) -> Option<String> {
    let affordable = catalogue.iter().filter(|fit| fit.ops <= ops);
    let best = affordable.min_by(|a, b| a.max.total_cmp(&b.max))?;
    let CatalogueFit { name, ops, max: error, .. } = best;
    let verdict = if *error < max { "less than this formula's" } else { "no less than this formula's" };
    Some(format!("{name} has a largest error of {error} for {}, {verdict}", operations(*ops)))
}

/// How an engine gets a formula for the target.
pub(crate) fn ways_out(target: &Target) -> String {
    format!("--out DIR writes include files; {}", by_scene(target))
}

/// How a scene takes a formula for the target.
pub(crate) fn by_scene(target: &Target) -> &'static str {
    if catalogue().iter().any(|effect| effect.takes_formulas_for(target)) {
        "a scene takes the formula by its file's name in wants.fit.hypotheses"
    } else {
        "scenes take formulas for the normalisation of ggx-reflection only"
    }
}
