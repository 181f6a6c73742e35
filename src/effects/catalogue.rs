//! The catalogues of all effects.

use super::{coupling, parallax, reflection, sheen};

/// Names of the functions of the catalogues.
pub fn catalogue_names() -> impl Iterator<Item = String> {
    let surfaces = reflection::catalogue_names().chain(coupling::catalogue_names());
    surfaces.chain(sheen::catalogue_names()).chain(parallax::catalogue_names())
}

/// Every WGSL source of the catalogues, in a fixed order: part of a bake's recipe.
pub fn catalogue_sources() -> impl Iterator<Item = &'static str> {
    let surfaces = reflection::catalogue_sources().chain(coupling::catalogue_sources());
    surfaces.chain(sheen::catalogue_sources()).chain(parallax::catalogue_sources())
}
