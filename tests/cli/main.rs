//! The program as its users call it.

#[path = "../common/mod.rs"]
mod common;

mod bad_points;
mod bad_scenes;
mod cache;
mod cost;
mod eval;
mod external;
mod fit;
mod fit_ends;
mod hypotheses;
mod kernels;
mod manual;
mod records;
mod search;
mod shards;
mod usage;
