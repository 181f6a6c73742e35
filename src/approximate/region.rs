//! The region of roughness and mu in which an approximation must hold.

use crate::data::{AlphaMap, nine_digits};

/// Ranges of roughness and mu, and how roughness becomes alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Roughness, inside [0, 1].
    pub roughness: [f64; 2],
    /// Cosine of the view, inside [0, 1].
    pub mu: [f64; 2],
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
}

impl Region {
    /// Range of alpha, to nine digits.
    pub fn alpha(&self) -> [f64; 2] {
        self.roughness.map(|r| nine_digits(self.alpha_map.alpha(r)))
    }
}
