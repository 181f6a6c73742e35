//! Proxies: the bodies that lookups take a room for.
//!
//! | proxy | where a ray meets it | parameter |
//! |---|---|---|
//! | [`Body`] | on the planes themselves | none |
//! | [`Tied`] | p-norm of the planes' distances along the ray ([`blended`]), p tied to how far the lobe reaches over an edge | its numerator ([`Tie`]) |
//!
//! **Hard places.** A plane that the ray goes towards and that the shading point is on, or outside
//! of, counts as [`NEAREST`] of the probe's distance to it away, so that the ray meets the proxy
//! there: the ratio of distances, and with it the width of the fetch, go to 0 continuously as a
//! shading point comes to a wall. Planes that the ray goes away from, or along, are not met at any
//! distance. All is finite for a ray of unit length from anywhere, and continuous in place and ray;
//! `None` only where no plane lies ahead, which no bounded body has.

mod body;
mod tied;

pub use body::{Body, NEAREST};
pub use tied::{Tie, Tied, blended};
