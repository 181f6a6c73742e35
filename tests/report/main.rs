//! Figures and pages.

#[path = "../baked_support/mod.rs"]
mod baked_support;
#[path = "../report_support/mod.rs"]
mod report_support;

mod browser;
mod explore;
mod input;
mod numbers;
mod page;
mod selection;
