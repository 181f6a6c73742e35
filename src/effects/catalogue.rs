//! The catalogues of all effects.

use super::{coupling, reflection, sheen};

/// Names of the functions of the catalogues.
pub fn catalogue_names() -> impl Iterator<Item = String> {
    reflection::catalogue_names().chain(coupling::catalogue_names()).chain(sheen::catalogue_names())
}

/// Every WGSL source of the catalogues, in a fixed order: part of a bake's recipe.
pub fn catalogue_sources() -> impl Iterator<Item = &'static str> {
    reflection::catalogue_sources().chain(coupling::catalogue_sources()).chain(sheen::catalogue_sources())
}
