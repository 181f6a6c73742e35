//! The effect `reflection`: the specular lobe of rough metals and dielectrics. Quantities `ggx-reflection` and `ggx-average`.

mod accuracy;
mod decode;
mod field;
mod lookup;
mod measure;
mod points;
mod region;
mod table;

pub use accuracy::{Series, Sources, Study, studies};
pub use field::{Counter, Field, TRUTH_ERROR};
pub use lookup::{Lookup, Split};
pub use measure::{Errors, LookupError, error_map, measure};
pub use points::{PointSet, certification};
pub use decode::{decode, lookup_ops};
pub use region::Region;
pub use table::{TableSpec, build};
