//! What this effect puts into the manifest.

use super::{EFFECT, Lobe};
use crate::data::Place;
use crate::effects::BakeError;
use crate::effects::parallax::{Gives, LevelFunction, Spread, Variation};
use crate::emit::manifest::canonical;
use crate::emit::manifest::{Entries, FitEntry, FitLeftOut, MipEntry, SpreadEntry, VariationEntry};
use crate::scene::Scene;

/// Notes what is emitted for a lobe, and what is left out.
pub(super) fn enter(lobe: &Lobe, scene: &Scene, entries: &mut Entries) -> Result<(), BakeError> {
    let (kernel, alpha_map) = (lobe.job.kernel.word(), scene.alpha.name());
    for (fit, variation) in lobe.measured().filter(|(fit, _)| fit.emitted) {
        if let Some(entry) = FitEntry::new(EFFECT, alpha_map, &fit.approximation) {
            entries.fits.push(canonical(&entry.fetching(kernel, beside(variation, &lobe.least)))?);
        }
    }
    for dropped in &lobe.dropped {
        entries.fits_left_out.push(canonical(&FitLeftOut {
            effect: EFFECT,
            hypothesis: dropped.hypothesis.clone(),
            norm: dropped.norm.into(),
            reason: dropped.reason.clone(),
        })?);
    }
    for function in &lobe.functions {
        let entry = canonical(&mip(function, alpha_map, kernel))?;
        // Maps do not depend on the lobe: two lobes have one function.
        if !entries.mips.contains(&entry) {
            entries.mips.push(entry);
        }
    }
    for lookup in &lobe.lookups {
        entries.lookups.push(canonical(&lookup.entry(kernel, alpha_map))?);
    }
    Ok(())
}

/// A total variation beside the least.
fn beside(variation: &Variation, least: &Variation) -> VariationEntry {
    let both = |(spread, least): (Spread, Spread)| SpreadEntry {
        mean: spread.mean,
        max: spread.max,
        at: place(&spread),
        least_mean: least.mean,
        least_max: least.max,
        cells: spread.cells,
    };
    VariationEntry {
        nearer: variation.nearer.zip(least.nearer).map(both),
        farther: variation.farther.zip(least.farther).map(both),
    }
}

/// Where the largest is.
pub(super) fn place(spread: &Spread) -> Place {
    let [roughness, rho] = spread.at;
    [("roughness", roughness), ("rho", rho)].map(|(name, x)| (name.to_string(), x)).into_iter().collect()
}

fn mip(function: &LevelFunction, alpha_map: &'static str, kernel: &'static str) -> MipEntry {
    let of_kernel = matches!(function.gives, Gives::Adjusted | Gives::Bias);
    let names = function.hypothesis.parameters().iter().map(|p| p.name.clone());
    MipEntry {
        effect: EFFECT,
        function: function.hypothesis.name().to_string(),
        gives: function.gives.name(),
        inputs: function.hypothesis.inputs().to_vec(),
        chain: function.chain.text(),
        alpha_map,
        kernel: of_kernel.then_some(kernel),
        coefficients: names.zip(function.coefficients.iter().copied()).collect(),
        max_mips: function.error.max,
        at: function.error.at.clone(),
        ops: function.hypothesis.tape().cost_ops(),
    }
}
