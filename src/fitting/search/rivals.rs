//! What the catalogue has for the same quantity and use: fits of ours at their declared constants, and published formulas.

use super::Rival;
use crate::approximate::certificate;
use crate::approximate::target::{Sampled, Target};
use crate::data::{AlphaMap, Smith, Use};
use crate::effects::{coupling, reflection, sheen};
use crate::fitting::FittingError;
use lobefit_shade::{Hypothesis, Precision};

/// How the names begin of the catalogue's formulas for a use of a quantity.
fn prefix(target: &Target) -> Option<&'static str> {
    match (target.quantity.name(), target.column, target.used_as) {
        ("ggx-reflection", "E", Use::Normalisation) => Some("ggx_norm_"),
        ("ggx-reflection", _, Use::F0Blend) => Some("ggx_blend_"),
        ("ggx-reflection", "E", Use::Value) => Some("ggx_e_"),
        ("ggx-reflection", "B", Use::Value) => Some("ggx_b_"),
        ("ggx-average", "E_avg", Use::Value) => Some("ggx_eavg_"),
        ("sheen-charlie", "E", Use::Value) => Some("charlie_e_"),
        _ => None,
    }
}

/// Measured at the same points; none where the conventions are others than the catalogue's.
pub(super) fn rivals(target: &Target, measured: &Sampled) -> Result<Vec<Rival>, FittingError> {
    let usual = target.variant.smith.unwrap_or_default() == Smith::Correlated
        && target.alpha_map == AlphaMap::RoughnessSquared;
    if !usual {
        return Ok(Vec::new());
    }
    let known = target.inputs();
    let mut rivals = Vec::new();
    for (name, source) in suiting(target) {
        let hypothesis = Hypothesis::parse(&format!("{name}.wgsl"), source)?;
        if !hypothesis.inputs().iter().all(|input| known.contains(input)) {
            continue;
        }
        let constants: Vec<f32> = hypothesis.parameters().iter().map(|p| p.start).collect();
        let certificate = certificate(&hypothesis, &constants, target, measured, Precision::F32)?;
        let ops = coupling::light_ops(&name)?.unwrap_or_else(|| hypothesis.tape().cost_ops());
        rivals.push(Rival {
            name,
            ops,
            max: certificate.max_abs,
            rms: certificate.rms,
            published: constants.is_empty(),
        });
    }
    Ok(rivals)
}

/// Names and sources of the formulas for the target's use.
fn suiting(target: &Target) -> Vec<(String, &'static str)> {
    if target.used_as == Use::Coupling {
        let all = target
            .variant
            .specular
            .into_iter()
            .flat_map(|s| coupling::hypotheses(s).iter().chain(coupling::rivals(s)));
        return all.map(|entry| (entry.name().to_string(), entry.source)).collect();
    }
    let Some(prefix) = prefix(target) else { return Vec::new() };
    catalogue().filter(|(name, _)| name.starts_with(prefix)).collect()
}

/// Names and sources of the catalogues of formulas that are known by their names.
fn catalogue() -> impl Iterator<Item = (String, &'static str)> {
    let sheen = sheen::RIVALS.iter().map(|entry| (entry.name().to_string(), entry.source));
    reflection::catalogue_names().zip(reflection::catalogue_sources()).chain(sheen)
}
