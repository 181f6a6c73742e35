//! Proxies: what a lookup takes a room for, each with one parameter that follows the width of the lobe by a [`Law`].
//!
//! | proxy | where a ray meets it | parameter |
//! |---|---|---|
//! | [`Body`] | on the planes themselves | none |
//! | [`Smooth`] | p-norm of the planes' distances along the ray, a smooth body about the shading point | the power p |
//! | [`Tied`] | the same, the power tied to how far the lobe reaches over an edge | its numerator ([`Tie`]) |
//! | [`Rounded`] | on the body whose edges are rounded by a radius | radius over the probe's distance to its nearest plane |
//! | [`Pushed`] | on the planes, but not nearer than a least distance | that distance over the same |
//! | [`Faded`] | on the planes, seen from a place between shading point and probe | the share of the way to the probe |
//!
//! **Hard places.** A plane that the ray goes towards and that the shading point is on, or outside of, counts as [`NEAREST`] of the
//! probe's distance to it away, so that the ray meets the proxy there: the ratio of distances, and with it the width of the fetch, go
//! to 0 continuously as a shading point comes to a wall. Planes that the ray goes away from, or along, are not met at any distance. All
//! is finite for a ray of unit length from anywhere, and continuous in place and ray; `None` only where no plane lies ahead, which no
//! bounded body has.

mod body;
mod law;
mod moved;
mod rounded;
mod smooth;
mod tied;

pub use body::{Body, NEAREST};
pub use law::Law;
pub use moved::{Faded, Pushed};
pub use rounded::Rounded;
pub use smooth::Smooth;
pub use tied::{Tie, Tied};
