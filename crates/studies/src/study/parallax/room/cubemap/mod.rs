//! The cubemap of a probe as an engine has it: faces of texels, a chain of levels prefiltered with
//! a lobe each, fetched by trilinear interpolation.

mod capture;
mod chain;
mod faces;
mod level;

pub use capture::Bake;
pub use chain::Chain;
pub use faces::{direction, face_of};
pub use level::Level;

/// Why there is no cubemap: what about it is wrong, and what to change.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct CubemapError(pub String);
