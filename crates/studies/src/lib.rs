//! The long experiments: the verb `lobefit report --study NAME`. Their pages are committed with the
//! hash of their recipe; no bake waits for them.
//!
//! | module | purpose |
//! |---|---|
//! | [`room`] | rooms of known light, cubemaps captured in them, lookups integrated in them |
//! | [`surface`] | Fresnel, colour and bases of whole materials, and their random walks |
//! | [`render`] | spheres in the light of an environment |
//! | [`flip`] | how different two pictures look |
//! | [`study`] | the studies themselves: what each covers and computes |
//! | [`report`] | their results and their pages |
//! | [`run`] | the verb |
//!
//! The program `lobefit` runs the binary of this package for its verb `report`, and `lobefit check`
//! asks it which studies are of other code.

mod cli;
pub mod flip;
pub mod render;
pub mod report;
pub mod room;
pub mod study;
pub mod surface;

pub use cli::run;
