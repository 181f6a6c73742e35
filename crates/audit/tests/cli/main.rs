//! The verb as its users call it.

#[path = "../../../../tests/common/mod.rs"]
mod common;

mod audit;
mod cost;
mod furnace;
mod shaders;
