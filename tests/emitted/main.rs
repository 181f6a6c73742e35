//! The emitted files in the hands of others: compilers, readers, a furnace. One bake of the
//! built-in scene serves all.

#[path = "../baked_support/mod.rs"]
mod baked_support;
#[path = "../code_support/mod.rs"]
mod code_support;
#[path = "../emit_support/mod.rs"]
mod emit_support;
#[path = "../fit_support/mod.rs"]
mod fit_support;
#[path = "../furnace_support/mod.rs"]
mod furnace_support;
#[path = "../lookup_support/mod.rs"]
mod lookup_support;

mod clearcoat;
mod committed;
mod coupling;
mod dielectric;
mod eon;
mod exr;
mod fitted_lobe;
mod formats;
mod fresh;
mod furnace;
mod furnace_coupling;
mod glass_compensation;
mod hardware;
mod include;
mod languages;
mod lookup_heads;
mod lookup_hit;
mod lookup_pictures;
mod lookups;
mod ltc;
mod mixed;
mod multiscatter;
mod parallax;
mod sliced;
mod subvoxels;
mod tools;
mod width;
