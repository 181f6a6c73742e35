//! Figures and pages.

#[path = "../report_support/mod.rs"]
mod report_support;

mod browser;
mod figures;
mod input;
mod page;
mod selection;
