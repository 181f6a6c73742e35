//! Effects: truths, tables, fits, whole materials, and what engines ship.

#[path = "../rivals_support/mod.rs"]
mod rivals_support;

mod parallax;
mod reflection_field;
mod reflection_fits;
mod reflection_table;
mod rivals;
mod rivals_coupling;
mod surface_energy;
mod taps;
mod target;
mod target_coupling;
mod texel_plan;
