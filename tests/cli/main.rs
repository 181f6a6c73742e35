//! The program as its users call it.

#[path = "../common/mod.rs"]
mod common;

mod audit;
mod bad_points;
mod bad_scenes;
mod cost;
mod eval;
mod fit;
mod fit_ends;
mod hypotheses;
mod kernels;
mod records;
mod search;
mod usage;
