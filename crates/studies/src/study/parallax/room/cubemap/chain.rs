//! A chain of prefiltered levels.

use super::CubemapError;
use super::level::{Edges, Format, Level};
use crate::study::parallax::room::{Fetch, Tap};
use lobefit::data::MipChain;
use lobefit_math::vector::{Vec3, plus, scaled};

/// Levels by a map of roughness r, the lobe of each having the width alpha = r^2.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    map: MipChain,
    levels: Vec<Level>,
    edges: Edges,
}

impl Chain {
    /// A chain of the levels that its map has.
    ///
    /// # Errors
    /// Another number of levels.
    pub fn new(map: MipChain, levels: Vec<Level>, edges: Edges) -> Result<Chain, CubemapError> {
        if map.count() != levels.len() {
            let (wanted, found) = (map.count(), levels.len());
            return Err(CubemapError(format!("the map of the chain has {wanted} levels, not {found}")));
        }
        Ok(Chain { map, levels, edges })
    }

    /// The same texels, read otherwise at edges.
    pub fn with_edges(&self, edges: Edges) -> Chain {
        Chain { edges, ..self.clone() }
    }

    /// The same texels in another format.
    ///
    /// # Errors
    /// A value that is not finite in the format.
    pub fn rounded(&self, format: Format) -> Result<Chain, CubemapError> {
        let levels = self.levels.iter().map(|level| level.rounded(format)).collect::<Result<_, _>>()?;
        Ok(Chain { map: self.map.clone(), levels, edges: self.edges })
    }

    /// The map of its levels.
    pub fn map(&self) -> &MipChain {
        &self.map
    }

    /// Its levels.
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// Bytes of its texels in 16 bits a channel, four channels.
    pub fn bytes(&self) -> usize {
        self.levels.iter().map(|level| 6 * level.size() * level.size() * 8).sum()
    }

    /// Trilinear interpolation at a level, which is clamped to those there are.
    pub fn at(&self, towards: Vec3, level: f64) -> [f64; 3] {
        trilinear(&self.levels, towards, level, self.edges)
    }
}

impl Fetch for Chain {
    fn fetch(&self, tap: &Tap) -> [f64; 3] {
        self.at(tap.towards, self.map.level(tap.alpha.sqrt()))
    }
}

/// Between the nearest two of some levels, one at least; beyond them the first or the last.
pub(super) fn trilinear(levels: &[Level], towards: Vec3, level: f64, edges: Edges) -> [f64; 3] {
    let level = level.clamp(0.0, (levels.len() - 1) as f64);
    let low = level.floor() as usize;
    let part = level - low as f64;
    let near = levels[low].fetch(towards, edges);
    match levels.get(low + 1).filter(|_| part > 0.0) {
        Some(next) => plus(scaled(near, 1.0 - part), scaled(next.fetch(towards, edges), part)),
        None => near,
    }
}
