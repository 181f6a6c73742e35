//! The verb as its users call it.

#[path = "../../../../tests/common/mod.rs"]
mod common;
#[path = "../foreign_support/mod.rs"]
#[allow(dead_code, reason = "files that are made to hurt are of some formats")]
mod foreign_support;

mod audit;
mod cost;
mod furnace;
mod hostile;
mod shaders;
