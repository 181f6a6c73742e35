//! The hypotheses of this effect and the published formulas that they compete with.

use crate::approximate::{Entry, own, published};

/// Width of a fetch by (alpha, rho), with free parameters, by rising cost.
pub const HYPOTHESES: [Entry; 3] = own!["parallax_1", "parallax_cubic", "parallax_power"];

/// Levels to add for a width, of a logarithmic chain.
pub(super) const BIAS: [Entry; 1] = own!["parallax_bias_log"];

/// What engines ship: measured and reported, not emitted.
pub const PUBLISHED: [Entry; 5] = published![
    "parallax_none" by "no correction",
    "parallax_frostbite" by "Lagarde and de Rousiers 2014, listing 25",
    "parallax_frostbite_text" by "Lagarde and de Rousiers 2014, section 4.9",
    "parallax_scaled" by "footprint ratio times alpha",
    "parallax_godot" by "Godot, pull request 106292",
];

/// Every file of the catalogue, in a fixed order.
pub(super) fn entries() -> impl Iterator<Item = &'static Entry> {
    HYPOTHESES.iter().chain(&BIAS).chain(&PUBLISHED)
}

/// Their WGSL sources: part of a study's recipe.
pub fn catalogue_sources() -> Vec<&'static str> {
    entries().map(|entry| entry.source).collect()
}
