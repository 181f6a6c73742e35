//! Readers of foreign files.

#[path = "../foreign_support/mod.rs"]
mod foreign_support;

mod images;
mod mutations;
mod published;
mod shaders;
mod shaders_hlsl;
mod shaders_shipped;
mod text;
