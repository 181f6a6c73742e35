//! The hypotheses of this effect and the published formulas that they compete with.

use crate::approximate::{Entry, own, published};

/// E(alpha, mu) with free parameters, by rising cost.
pub const HYPOTHESES: [Entry; 8] = own![
    "charlie_e_8",
    "charlie_e_9",
    "charlie_e_11",
    "charlie_e_14",
    "charlie_e_16",
    "charlie_e_rational",
    "charlie_e_exp",
    "charlie_e_gauss",
];

/// E(roughness, mu) as engines ship it: measured and reported, not emitted.
pub const RIVALS: [Entry; 1] = published!["charlie_e_threejs" by "three.js, IBLSheenBRDF, 2025"];

/// Names of the functions of the catalogue: those of the files.
pub fn catalogue_names() -> impl Iterator<Item = String> {
    HYPOTHESES.iter().chain(&RIVALS).map(|entry| entry.name().to_string())
}

/// Every WGSL source of the catalogue, in a fixed order: part of a bake's recipe.
pub fn catalogue_sources() -> impl Iterator<Item = &'static str> {
    HYPOTHESES.iter().chain(&RIVALS).map(|entry| entry.source)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobefit_shade::Hypothesis;

    #[test]
    fn functions_are_named_like_their_files() {
        for (entry, name) in HYPOTHESES.iter().chain(&RIVALS).zip(catalogue_names()) {
            assert_eq!(Hypothesis::parse(entry.file, entry.source).expect("parses").name(), name);
        }
    }
}
