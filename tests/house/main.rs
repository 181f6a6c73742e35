//! The sources, the README and the pages in `docs/` themselves.

#[path = "../baked_support/mod.rs"]
mod baked_support;
#[path = "../common/mod.rs"]
mod common;

mod actions;
mod cycles;
mod docs;
mod floors;
mod from_outside;
mod languages;
mod offline;
mod readme;
mod texts;
mod toy_effect;
