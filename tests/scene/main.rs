//! Scenes, their limits and plans.

#[path = "../common/mod.rs"]
mod common;

mod bad_files;
mod expected_time;
mod gltf;
mod hostile;
mod limits;
mod materialx;
mod plan;
mod readers;
mod schema;
mod sliced;
mod textures;
