//! The experiment that the distance-to-roughness idea comes from, read literally: lobes compared
//! over the window [-1, 1] of a wall in distance 1, one face of a cube, where the fetch may be
//! scaled and shifted beside being widened.
//!
//! The target over x is the lobe of width alpha from distance d, f(x/d), the fetch scale f(x;
//! alpha') + offset; both peaks are 1. Scale and offset are linear: for every alpha' they follow
//! from 2 x 2 normal equations, and alpha' alone is searched. [`fits`] does so on a wall at right
//! angles, [`slanted`] on one at a slant, over the square window, with a scale and without an
//! offset.

mod fit;
mod slanted;

pub use fit::{Ordinate, WindowFit, fits, ordinate};
pub use slanted::{SlantedFit, profile, slanted};

pub(super) const QUANTITY: &str = "window of a footprint";
