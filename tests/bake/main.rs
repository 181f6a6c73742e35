//! Scenes to files.

#[path = "../common/mod.rs"]
mod common;
#[path = "../volume_support/mod.rs"]
mod volume_support;

mod deterministic;
mod only;
mod parallax;
mod regions;
mod scenes;
mod sheen;
mod volumes;
