//! Emitted code on a Vulkan device: what it computes, and how long it takes.

#[path = "../../../../tests/baked_support/mod.rs"]
mod baked_support;
#[path = "../../../../tests/common/mod.rs"]
mod common;
#[path = "../../../../tests/emit_support/mod.rs"]
mod emit_support;
#[path = "../gpu_support/mod.rs"]
mod gpu_support;
#[path = "../../../../tests/lookup_support/mod.rs"]
mod lookup_support;

mod cli;
mod cost;
mod isa;
mod lookups;
mod machine;
mod shaders;
mod sliced;
mod subvoxels;
mod weights;
mod wgsl;
