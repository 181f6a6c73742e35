//! What this effect puts into the manifest.

use super::Lobe;
use crate::data::Place;
use crate::effects::Effect;
use crate::effects::parallax::Parallax;
use crate::effects::parallax::{Gives, LevelFunction, Spread, Variation};
use crate::emit::call::MipEntry;
use crate::emit::manifest::{Entries, FitEntry, SpreadEntry, VariationEntry};

/// Notes the functions of levels and of lookups.
pub(super) fn enter(lobe: &Lobe, alpha_map: &str, entries: &mut Entries) {
    let kernel = lobe.spec.kernel.word();
    for function in &lobe.functions {
        let entry = mip(function, alpha_map, kernel);
        // Maps do not depend on the lobe: two lobes have one function.
        if !entries.mips.contains(&entry) {
            entries.mips.push(entry);
        }
    }
    entries.lookups.extend(lobe.lookups.iter().map(|lookup| lookup.entry(kernel, alpha_map)));
}

/// The entry of the fit at an index with its total variation.
pub(super) fn fetching(lobe: &Lobe, i: usize, entry: FitEntry) -> FitEntry {
    entry.fetching(lobe.spec.kernel.word(), beside(&lobe.variations[i], &lobe.least))
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

fn mip(function: &LevelFunction, alpha_map: &str, kernel: &str) -> MipEntry {
    let of_kernel = matches!(function.gives, Gives::Adjusted | Gives::Bias);
    let names = function.hypothesis.parameters().iter().map(|p| p.name.clone());
    MipEntry {
        effect: Parallax.name().into(),
        function: function.hypothesis.name().to_string(),
        gives: function.gives.name().into(),
        inputs: function.hypothesis.inputs().to_vec(),
        chain: function.chain.text(),
        alpha_map: alpha_map.into(),
        kernel: of_kernel.then(|| kernel.into()),
        coefficients: names.zip(function.coefficients.iter().copied()).collect(),
        max_mips: function.error.max,
        at: function.error.at.clone(),
        ops: function.hypothesis.tape().cost_ops(),
    }
}
