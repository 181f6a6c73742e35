//! Figures, pages, pictures and studies.

#[path = "../common/mod.rs"]
mod common;
#[path = "../flip_support/mod.rs"]
mod flip_support;
#[path = "../report_support/mod.rs"]
mod report_support;

mod figures;
mod flip;
mod input;
mod page;
mod parallax;
mod parallax_chain;
mod render;
mod selection;
mod study;
