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

/// Why there is no cubemap.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CubemapError {
    /// Faces that cannot be halved as often as there are levels.
    #[error("faces of {size} texels a side have no {levels} levels; choose a size that 2^{} divides", levels - 1)]
    Size {
        /// Texels along a side of the first level.
        size: usize,
        /// Levels.
        levels: usize,
    },
    /// Another number of texels than six faces have.
    #[error("a level of {size} texels a side has {wanted} texels, not {found}")]
    Texels {
        /// Texels along a side.
        size: usize,
        /// Those of six faces.
        wanted: usize,
        /// Those given.
        found: usize,
    },
    /// A radiance that the format has no number for.
    #[error(
        "texel {texel} of a level of {size} texels a side: {value} is no finite number in {bits} bits; scale the light"
    )]
    Overflow {
        /// Index of the texel.
        texel: usize,
        /// Texels along a side.
        size: usize,
        /// The value.
        value: f64,
        /// Bits of the format.
        bits: u32,
    },
    /// Another number of levels than the map of the chain says.
    #[error("the map of the chain has {wanted} levels, not {found}")]
    Levels {
        /// Those of the map.
        wanted: usize,
        /// Those given.
        found: usize,
    },
    /// No samples.
    #[error("{field} is 0; at least one sample is needed")]
    Samples {
        /// Which number.
        field: &'static str,
    },
}
