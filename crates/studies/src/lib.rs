//! The long experiments: the verb `lobefit report --study NAME`. Their pages are committed with the
//! hash of their recipe; no bake waits for them.
//!
//! | module | purpose |
//! |---|---|
//! | [`render`] | spheres in the light of an environment |
//! | [`flip`] | how different two pictures look |
//! | [`study`] | the studies, a folder each: what it covers, its results and its page |
//! | [`run`] | the verb |
//!
//! The program `lobefit` runs the binary of this package for its verb `report`, and `lobefit check`
//! asks it which studies are of other code.

mod cli;
pub mod flip;
pub mod render;
pub mod study;

pub use cli::run;
