//! What the catalogue has for the same quantity and use: fits of ours at their declared constants,
//! and published formulas.

use serde_json::{Value, json};

use super::FittingError;
use lobefit::approximate::certificate;
use lobefit::approximate::target::{Sampled, Target};
use lobefit::data::{AlphaMap, Model, Smith};
use lobefit::effects::catalogue;
use lobefit_shade::{Hypothesis, Precision};

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

/// What the catalogue has of at most `most` operations, measured at the same points; nothing where
/// the conventions are others than the catalogue's.
pub(crate) fn fits(
    target: &Target,
    measured: &Sampled,
    most: u32,
    model: Option<&Model>,
) -> Result<Vec<CatalogueFit>, FittingError> {
    let usual = target.variant.smith.unwrap_or_default() == Smith::Correlated
        && target.alpha_map == AlphaMap::RoughnessSquared;
    if !usual {
        return Ok(Vec::new());
    }
    let known = target.inputs();
    let mut fits = Vec::new();
    let all =
        catalogue().iter().flat_map(|effect| effect.formulas_for(target).into_iter().map(|e| (*effect, e)));
    for (effect, entry) in all {
        let name = entry.name().to_string();
        let hypothesis = Hypothesis::parse(&format!("{name}.wgsl"), entry.source)?;
        if !hypothesis.inputs().iter().all(|input| known.contains(input)) {
            continue;
        }
        let ops = effect.operations(&hypothesis)?;
        if ops > most {
            continue;
        }
        let constants: Vec<f32> = hypothesis.parameters().iter().map(|p| p.start).collect();
        let certificate = certificate(&hypothesis, &constants, target, measured, Precision::F32)?;
        fits.push(CatalogueFit {
            name,
            ops,
            price: model.map_or_else(|| f64::from(ops), |model| model.cost(hypothesis.tape())),
            max: certificate.max_abs,
            rms: certificate.rms,
            published: constants.is_empty(),
        });
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
    Some(format!("{name} has a largest error of {error} for {ops} operations, {verdict}"))
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
