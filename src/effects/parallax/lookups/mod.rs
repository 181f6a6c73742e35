//! Lookups of a probe's cubemap: what engines ship, what the literature proposes, and ours, put
//! together from
//!
//! - what the lobe of the surface is taken for ([`Shading`]): round about the mirror ray, leaning
//!   towards the normal, narrower across the plane of incidence;
//! - how many fetches stand for it ([`TapRule`](super::TapRule));
//! - what the room is taken for ([`Proxy`](crate::effects::parallax::room::Proxy));
//! - how much wider it looks from the probe ([`Ratio`]), and which width is fetched for that
//!   ([`Width`]).

mod corrected;
mod shading;

pub use corrected::{Corrected, Ratio, Uncorrected, Width};
pub use shading::{LEAST_COSINE, LobeFit, NARROWEST, Shading, ShadingLobe};
