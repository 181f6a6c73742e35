//! What is measured of whole materials beyond furnace and reciprocity: [`colour`] rough metals and
//! [`random_walk`] the random walk of facets. [`SurfaceRows`] gathers the rows for a page.

pub mod colour;
mod fingerprint;
pub mod random_walk;
mod rows;

pub use fingerprint::{Fingerprint, fingerprint};
pub use lobefit::effects::coupling::surface::{
    Albedos, Base, Coupling, Facet, Factor, FactorAt, Lobe, Material, Side, Surface, SurfaceError, cost,
    formula, measure, table,
};
pub use rows::{SurfaceRows, Wanted};
