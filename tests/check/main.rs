//! `lobefit check`.

#[path = "../common/mod.rs"]
mod common;
#[path = "../volume_support/mod.rs"]
mod volume_support;

mod planted;
mod strays;
mod values;
mod volumes;
