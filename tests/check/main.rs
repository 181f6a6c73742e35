//! `lobefit check`.

#[path = "../baked_support/mod.rs"]
mod baked_support;
#[path = "../common/mod.rs"]
mod common;
#[path = "../sliced_support/mod.rs"]
mod sliced_support;

mod changed;
mod planted;
mod strays;
mod texts;
mod values;
