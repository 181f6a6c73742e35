//! Several fetches for one lobe whose axis meets the wall at a slant.
//!
//! Directions about the mirror ray, from the shading point through the wall to directions from the
//! probe, are mapped by M; its singular values s1 >= s2 make the footprint an ellipse of stretch
//! kappa = s1/s2 ([`Stretch`]). A [`TapRule`] lays fetches along the long axis; each is a ray of
//! its own, traced to the proxy, narrowed or widened by its own ratio of footprints ([`width`]);
//! [`Corrected`](super::Corrected) does so for a shading point.

pub mod best;
pub mod constants;
pub mod expected;
pub mod fit;
pub mod horizon;
pub mod least;
mod rule;

pub use constants::Constants;
pub use lobefit_truth::optics::footprint::{RuleTap, Stretch, width};
pub use rule::TapRule;
