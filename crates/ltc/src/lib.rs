//! Linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt, "Real-Time Polygonal-Light Shading
//! with Linearly Transformed Cosines", 2016) of isotropic lobes: the matrix of a view, the light
//! that a polygon sends by it, and how far that is from what the lobe itself sends.
//!
//! Directions are (x, y, z) about the normal z, the view lies at +x: the lobe leans to -x.

mod error;
mod fit;
mod lobe;
mod matrix;
mod measure;
mod pair;
mod polygon;
mod quad;
mod square;

pub use error::LtcError;
pub use fit::{fitted, misplaced};
pub use lobe::{Lobe, View};
pub use matrix::Matrix;
pub use measure::{Deviation, Measured, Setting, measured};
pub use pair::{Lookup, Pair, SIDE, bytes, side_within};
pub use polygon::{cosine_share, proxy_share, sphere_share, vector_share};
pub use quad::{FUNCTIONS, QUAD, Quad, TEXT};
pub use square::{PER_PLACE, Share, Square, squares};
