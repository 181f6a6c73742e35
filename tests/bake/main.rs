//! Scenes to files.

#[path = "../baked_support/mod.rs"]
mod baked_support;
#[path = "../common/mod.rs"]
mod common;
#[path = "../sliced_support/mod.rs"]
mod sliced_support;

mod cached;
mod deterministic;
mod five_axes;
mod one_value;
mod only;
mod parallax;
mod pick;
mod promised;
mod regions;
mod scenes;
mod sheen;
mod sliced;
mod store;
