//! Proxies that the study compares with those of emitted lookups, each with one parameter that
//! follows the width of the lobe by a [`Law`].
//!
//! | proxy | where a ray meets it | parameter |
//! |---|---|---|
//! | [`Smooth`] | p-norm of the planes' distances along the ray, a smooth body about the shading point | the power p |
//! | [`Tied`] | the same, p tied to how far the lobe reaches over an edge | its numerator ([`Tie`]) |
//! | [`Rounded`] | on the body whose edges are rounded by a radius | radius over the probe's distance to its nearest plane |
//! | [`Pushed`] | on the planes, but not nearer than a least distance | that distance over the same |
//! | [`Faded`] | on the planes, seen from a place between shading point and probe | the share of the way to the probe |

mod law;
mod moved;
mod rounded;
mod smooth;
mod tied;

pub use law::Law;
pub use lobefit::effects::parallax::room::proxies::{Body, Eased, NEAREST};
pub use moved::{Faded, Pushed};
pub use rounded::Rounded;
pub use smooth::Smooth;
pub use tied::{Tie, Tied, blended};
