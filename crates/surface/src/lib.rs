//! A whole material as a function of two directions, f(l, v): what a renderer shades with, and what
//! furnace and reciprocity are measured on.
//!
//! [`Surface`] evaluates a [`Material`]: a GGX lobe with one of five ways to treat the light that
//! single scattering loses ([`Lobe`]), over a diffuse base with one of the published ways to take
//! what the lobe leaves ([`Coupling`]). The formulas themselves are in
//! `optics::{fresnel, multiscatter, diffuse}`, the albedos that they need are integrated once per
//! alpha ([`Albedos`]). [`measure`] sends light through the result, [`table`] does so for every
//! lobe over every coupling.

mod albedos;
mod cost;
mod error;
mod evaluate;
mod material;
pub mod measure;
mod row;
pub mod table;

pub use albedos::{ALPHA, Albedos, Column};
pub use cost::{Cost, cost, formula, source};
pub use error::SurfaceError;
pub use evaluate::{Facet, Parts, Side, Surface};
pub use material::{Base, Coupling, Factor, FactorAt, Lobe, Material};
