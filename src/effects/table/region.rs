//! The region in which a table of three axes must hold.

use super::Point;
use crate::data::{AlphaMap, nine_digits};

/// The third input of a table, after mu and roughness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Third {
    /// Anisotropy a in [0, 1]: aspect = sqrt(1 - 0.9 a), alpha_x = alpha/aspect, alpha_y = alpha aspect (Burley 2012).
    #[default]
    Anisotropy,
    /// Index of refraction, inside over outside.
    Ior,
}

impl Third {
    /// Its name in axes, certificates and arguments.
    pub fn name(self) -> &'static str {
        match self {
            Third::Anisotropy => "anisotropy",
            Third::Ior => "ior",
        }
    }

    /// Its value at a point.
    pub fn of(self, point: &Point) -> f32 {
        match self {
            Third::Anisotropy => point.anisotropy,
            Third::Ior => point.ior,
        }
    }
}

/// Ranges of the inputs, and how roughness becomes alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Roughness, inside [0, 1].
    pub roughness: [f64; 2],
    /// Cosine of the view, inside [0, 1].
    pub mu: [f64; 2],
    /// The third input.
    pub third: Third,
    /// Its range.
    pub span: [f64; 2],
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
}

impl Region {
    /// Range of alpha, to nine digits.
    pub fn alpha(&self) -> [f64; 2] {
        self.roughness.map(|r| nine_digits(self.alpha_map.alpha(r)))
    }
}

/// aspect = sqrt(alpha_y/alpha_x) of an anisotropy in [0, 1].
pub fn aspect(anisotropy: f64) -> f64 {
    (1.0 - 0.9 * anisotropy).sqrt()
}
