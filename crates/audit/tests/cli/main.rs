//! The verb as its users call it.

#[path = "../../../../tests/common/mod.rs"]
mod common;
#[path = "../foreign_support/mod.rs"]
mod foreign_support;

mod audit;
mod cost;
mod examples;
mod furnace;
mod hostile;
mod ltc;
mod shaders;
