//! Proxies: the bodies that lookups take a room for.
//!
//! | proxy | where a ray meets it | parameter |
//! |---|---|---|
//! | [`Body`] | on the planes themselves | none |
//! | [`Eased`] | on the planes, edges rounded by how far the lobe reaches over them | the width of the lobe |
//!
//! **Hard places.** A plane that the ray goes towards and that the shading point is outside of
//! counts as being as far ahead as it is behind: a place on a wall meets it at once, one far
//! outside sees about what an uncorrected fetch gives. A distance below [`NEAREST`] counts as that.
//! Planes that the ray goes away from, or along, are not met at any distance. All is finite for a
//! ray of unit length from anywhere, and continuous in place and ray; `None` only where no plane
//! lies ahead, which no bounded body has.

mod body;
mod eased;

pub use body::{Body, NEAREST};
pub use eased::Eased;
