//! What the effects with tables of three axes share: mu along columns, roughness along rows, a third input along slices.

mod lookup;
mod measure;
mod points;
mod region;

pub use lookup::{Lookup, LookupError, Point};
pub use measure::{Errors, error_map, measure};
pub use points::{GROUP, Points};
pub use region::{Region, Third, aspect};
