//! The program as its users call it.

#[path = "../baked_support/mod.rs"]
mod baked_support;
#[path = "../common/mod.rs"]
mod common;
#[path = "../kernel_support/mod.rs"]
mod kernel_support;

mod bad_points;
mod bad_scenes;
mod cache;
mod cost;
mod eval;
mod external;
#[cfg(unix)]
mod folders;
#[cfg(target_os = "linux")]
mod hostile;
mod hypotheses;
mod kernels;
#[cfg(unix)]
mod killed;
mod manual;
mod pipes;
mod records;
mod shards;
mod tables;
mod usage;
mod weights;
