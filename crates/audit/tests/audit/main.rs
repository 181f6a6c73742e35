//! Foreign tables and functions against the truth.

#[path = "../../../../tests/baked_support/mod.rs"]
mod baked_support;
#[path = "../../../../tests/common/mod.rs"]
mod common;

mod channels;
mod declared;
mod functions;
mod furnace;
mod lobes;
mod made;
mod points;
mod shipped;
mod sidecars;
mod solids;
mod tables;
mod zoo;
