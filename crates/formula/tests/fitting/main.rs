//! What a fit minimises.

#[path = "../../../../tests/common/mod.rs"]
mod common;

mod perceptual;
mod power_norm;
