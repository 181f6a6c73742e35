//! Effects: truths, tables, fits, whole materials, and what engines ship.

#[path = "../rivals_support/mod.rs"]
mod rivals_support;

mod cubemap;
mod parallax;
mod patches;
mod proxies;
mod reflection_field;
mod reflection_fits;
mod reflection_table;
mod rivals;
mod rivals_coupling;
mod rooms;
mod surface_energy;
mod surface_report;
mod surface_tables;
mod taps;
mod target;
mod target_coupling;
mod viewpoints;
mod volume_table;
