//! The region of roughness and mu in which an approximation must hold.

use crate::data::AlphaMap;

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
    /// Range of alpha, to nine digits: 0.1 squared is 0.01.
    pub fn alpha(&self) -> [f64; 2] {
        let nine = |x: f64| format!("{x:.8e}").parse().unwrap_or(x);
        self.roughness.map(|r| nine(self.alpha_map.alpha(r)))
    }
}
