//! Foreign tables and functions against the truth.

#[path = "../../../../tests/common/mod.rs"]
mod common;

mod declared;
mod functions;
mod sidecars;
mod solids;
mod tables;
mod zoo;
