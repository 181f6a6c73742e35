//! The emitted files in the hands of others: compilers, readers, a Vulkan device, a furnace. One bake of the built-in scene serves all.

#[path = "../code_support/mod.rs"]
mod code_support;
#[cfg(feature = "gpu")]
#[path = "../common/mod.rs"]
mod common;
#[path = "../emit_support/mod.rs"]
mod emit_support;
#[path = "../fit_support/mod.rs"]
mod fit_support;
#[path = "../furnace_support/mod.rs"]
mod furnace_support;
#[cfg(feature = "gpu")]
#[path = "../gpu_support/mod.rs"]
mod gpu_support;

mod committed;
mod coupling;
mod fitted_lobe;
mod formats;
mod furnace;
mod furnace_coupling;
mod gpu_cost;
mod gpu_lookups;
mod gpu_shaders;
mod gpu_volume;
mod gpu_wgsl;
mod languages;
mod lookup_heads;
mod lookup_pictures;
mod lookups;
mod parallax;
mod tools;
mod volume;
