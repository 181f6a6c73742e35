//! Figures and pages.

#[path = "../baked_support/mod.rs"]
mod baked_support;
#[path = "../report_support/mod.rs"]
mod report_support;

mod browser;
mod figures;
mod input;
mod page;
mod selection;
