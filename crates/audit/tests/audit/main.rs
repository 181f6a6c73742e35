//! Foreign tables and functions against the truth.

#[path = "../../../../tests/baked_support/mod.rs"]
mod baked_support;
#[path = "../../../../tests/common/mod.rs"]
mod common;

mod axes;
mod declared;
mod defects;
mod functions;
mod furnace;
mod points;
mod solids;
mod support;
mod tables;
mod verdicts;
mod zoo;
