//! Effects: truths, tables, fits, whole materials, and what engines ship.

#[path = "../baked_support/mod.rs"]
mod baked_support;
#[path = "../fit_support/mod.rs"]
mod fit_support;
#[path = "../published_support/mod.rs"]
mod published_support;

mod accuracy;
mod axis;
mod azimuth;
mod beckmann_fits;
mod catalogue;
mod hypotheses;
mod lookup;
mod parallax;
mod probe;
mod published;
mod published_coupling;
mod reflection_field;
mod reflection_fits;
mod reflection_table;
mod surface_energy;
mod taps;
mod target;
mod target_coupling;
mod texel_plan;
mod worst;
