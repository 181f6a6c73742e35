//! Scenes, their limits and plans.

#[path = "../common/mod.rs"]
mod common;

mod limits;
mod plan;
mod schema;
mod volumes;
