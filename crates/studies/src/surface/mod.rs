//! What is measured of whole materials beyond furnace and reciprocity: [`interface`] compares Schlick's Fresnel with the exact one,
//! [`darker`] measures bases below white, [`colour`] rough metals and [`opinion`] the random walk of facets. [`SurfaceRows`] gathers the
//! rows for a page.

pub mod colour;
pub mod darker;
mod fingerprint;
pub mod interface;
pub mod opinion;
mod rows;

pub use fingerprint::{Fingerprint, fingerprint};
pub use lobefit::effects::coupling::surface::{
    Albedos, Base, Coupling, Facet, Factor, FactorAt, Fresnel, Lobe, Material, Side, Surface, SurfaceError,
    cost, formula, measure, table,
};
pub use rows::{Fixed, SurfaceRows, Wanted};
