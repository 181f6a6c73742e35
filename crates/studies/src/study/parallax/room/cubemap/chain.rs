//! A chain of prefiltered levels.

use super::CubemapError;
use super::level::Level;
use crate::study::parallax::room::{Fetch, Tap};
use lobefit::data::MipChain;
use lobefit_math::vector::{Vec3, plus, scaled};

/// Levels by a map of roughness r, the lobe of each having the width alpha = r^2.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    map: MipChain,
    levels: Vec<Level>,
}

impl Chain {
    /// A chain of the levels that its map has.
    ///
    /// # Errors
    /// Another number of levels.
    pub fn new(map: MipChain, levels: Vec<Level>) -> Result<Chain, CubemapError> {
        if map.count() != levels.len() {
            let (wanted, found) = (map.count(), levels.len());
            return Err(CubemapError(format!("the map of the chain has {wanted} levels, not {found}")));
        }
        Ok(Chain { map, levels })
    }

    /// The map of its levels.
    pub fn map(&self) -> &MipChain {
        &self.map
    }

    /// Its levels.
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// Trilinear interpolation at a level, which is clamped to those there are.
    pub fn at(&self, towards: Vec3, level: f64) -> [f64; 3] {
        let level = level.clamp(0.0, (self.levels.len() - 1) as f64);
        let low = level.floor() as usize;
        let part = level - low as f64;
        let near = self.levels[low].fetch(towards);
        match self.levels.get(low + 1).filter(|_| part > 0.0) {
            Some(next) => plus(scaled(near, 1.0 - part), scaled(next.fetch(towards), part)),
            None => near,
        }
    }
}

impl Fetch for Chain {
    fn fetch(&self, tap: &Tap) -> [f64; 3] {
        self.at(tap.towards, self.map.level(tap.alpha.sqrt()))
    }
}
