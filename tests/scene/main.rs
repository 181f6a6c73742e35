//! Scenes, their limits and plans.

#[path = "../common/mod.rs"]
mod common;

mod expected_time;
mod gltf;
mod limits;
mod plan;
mod schema;
mod sliced;
