//! The hypotheses of this effect and the published formulas that they compete with.

use super::published::{LIGHTS, OWN_SPECULAR, PUBLISHED};
use crate::approximate::{Entry, own};
use lobefit_truth::quantity::Specular;

const NORMALISED: [Entry; 11] = own![
    "coupling_normalised_7",
    "coupling_normalised_8",
    "coupling_normalised_9",
    "coupling_normalised_10",
    "coupling_normalised_11",
    "coupling_normalised_12",
    "coupling_normalised_13",
    "coupling_normalised_14",
    "coupling_normalised_15",
    "coupling_normalised_16",
    "coupling_normalised_18",
];

const SINGLE: [Entry; 4] =
    own!["coupling_single_7", "coupling_single_16", "coupling_single_22", "coupling_single_30",];

const COMPENSATED: [Entry; 5] = own![
    "coupling_compensated_7",
    "coupling_compensated_14",
    "coupling_compensated_17",
    "coupling_compensated_24",
    "coupling_compensated_32",
];

/// The factor of a white base under a lobe of this kind, with free parameters, by rising cost.
pub fn hypotheses(specular: Specular) -> &'static [Entry] {
    match specular {
        Specular::Single => &SINGLE,
        Specular::Normalised => &NORMALISED,
        Specular::Compensated => &COMPENSATED,
    }
}

/// What engines ship: formulas that are the same under every lobe, and those that are 1 less a
/// fitted lobe of this kind.
pub fn published(specular: Specular) -> impl Iterator<Item = &'static Entry> {
    PUBLISHED
        .iter()
        .chain(OWN_SPECULAR.iter().filter(move |own| own.specular == specular).map(|own| &own.entry))
}

/// Every file of the catalogue, in a fixed order.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    let ours = Specular::ALL.into_iter().flat_map(hypotheses);
    ours.chain(&PUBLISHED).chain(OWN_SPECULAR.iter().map(|own| &own.entry))
}

/// Every WGSL source of the catalogue, in a fixed order: part of a bake's recipe.
pub fn sources() -> impl Iterator<Item = &'static str> {
    entries().map(|entry| entry.source).chain(LIGHTS.map(|(_, light)| light))
}
