//! The studies, and the pictures and comparisons that they are made with.

#[path = "../../../../tests/common/mod.rs"]
mod common;
#[path = "../flip_support/mod.rs"]
mod flip_support;

mod flip;
mod parallax;
mod parallax_chain;
mod render;
mod stability;
mod study;
