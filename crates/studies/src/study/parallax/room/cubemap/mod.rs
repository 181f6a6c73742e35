//! The cubemap of a probe as an engine has it: faces of texels, a chain of levels prefiltered with
//! a lobe each, fetched by trilinear interpolation.
//!
//! What of the error of a lookup is the chain's own can be separated part by part: a level is
//! captured or integrated ([`Source`]), stored in 16 or 32 bits ([`Format`]) and read across the
//! edges of its faces or not ([`Edges`]); [`Integrated`] fetches without any of them. [`Viewpoint`]
//! says from where the texels of a level see the room: from the probe, or from above the wall that
//! they show.

mod capture;
mod chain;
mod faces;
mod integrated;
mod level;
mod viewpoint;

pub use capture::{Bake, Source};
pub use chain::Chain;
pub use faces::{direction, face_of, solid_angle};
pub use integrated::Integrated;
pub use level::{Edges, Format, Level};
pub use viewpoint::{Eye, Viewpoint, to_edge};

/// Why there is no cubemap: what about it is wrong, and what to change.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct CubemapError(pub String);
