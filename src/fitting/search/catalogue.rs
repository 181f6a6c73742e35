//! What the catalogue has for the same quantity and use: fits of ours at their declared constants,
//! and published formulas.

use super::CatalogueFit;
use crate::approximate::certificate;
use crate::approximate::target::{Sampled, Target};
use crate::data::{AlphaMap, Smith};
use crate::effects::catalogue;
use crate::fitting::FittingError;
use lobefit_shade::{Hypothesis, Precision};

/// Measured at the same points; none where the conventions are others than the catalogue's.
pub(super) fn fits(target: &Target, measured: &Sampled) -> Result<Vec<CatalogueFit>, FittingError> {
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
        let constants: Vec<f32> = hypothesis.parameters().iter().map(|p| p.start).collect();
        let certificate = certificate(&hypothesis, &constants, target, measured, Precision::F32)?;
        let ops = effect.operations(&hypothesis)?;
        fits.push(CatalogueFit {
            name,
            ops,
            max: certificate.max_abs,
            rms: certificate.rms,
            published: constants.is_empty(),
        });
    }
    Ok(fits)
}
