//! Chains made from a room.

use rayon::prelude::*;

use super::faces::{centre, direction};
use super::{Chain, CubemapError, Level};
use crate::study::parallax::room::{Outlook, Rays, Room};
use lobefit::data::MipChain;
use lobefit_math::vector::{plus, scaled, tangents};
use lobefit_truth::optics::kernel::Kernel;

/// Most rays of a texel over those of the first level's.
const MOST_TIMES: usize = 16;

/// How a chain is made.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Bake {
    /// The lobe of a level.
    pub kernel: Kernel,
    /// Levels and their roughness; alpha = roughness^2.
    pub map: MipChain,
    /// Texels along a side of a face of the first level; each further level has half of them.
    pub size: usize,
    /// Samples along a side of a texel of a level of roughness 0: the mean radiance over the solid
    /// angle of the texel by the midpoint rule, off by about their power -3/2 of the contrast where
    /// an edge of the room's pattern crosses.
    pub samples: usize,
    /// Rays of a texel as large as those of the first level; one twice as large has twice as many,
    /// up to 16 times.
    pub rays: u32,
    /// Seed of the rays; every texel has the same about its own axis.
    pub seed: u32,
}

impl Bake {
    /// The chain of a room's probe.
    ///
    /// # Errors
    /// A size that cannot be halved as often as there are levels; no samples; radiance that 16
    /// bits have no number for.
    pub fn chain(&self, room: &Room) -> Result<Chain, CubemapError> {
        let levels = self.map.count();
        if self.size == 0 || !self.size.is_multiple_of(1 << (levels - 1).min(usize::BITS as usize - 1)) {
            let (size, halvings) = (self.size, levels - 1);
            return Err(CubemapError(format!(
                "faces of {size} texels a side have no {levels} levels; choose a size that 2^{halvings} divides"
            )));
        }
        for (count, field) in [(self.samples, "samples"), (self.rays as usize, "rays")] {
            if count == 0 {
                return Err(CubemapError(format!("{field} is 0; at least one sample is needed")));
            }
        }
        let level = |i: usize| {
            let size = self.size >> i;
            let roughness = self.map.roughness(i as f64);
            let alpha = roughness * roughness;
            // a ray is no lobe: the mean of what the texel covers
            let texels =
                if alpha == 0.0 { self.captured(room, size) } else { self.prefiltered(room, size, alpha) };
            Level::new(size, &texels)
        };
        let levels = (0..levels).map(level).collect::<Result<Vec<_>, _>>()?;
        Chain::new(self.map.clone(), levels)
    }

    /// Mean radiance of the texels of a level.
    fn captured(&self, room: &Room, size: usize) -> Vec<[f64; 3]> {
        let (fine, side) = (size * self.samples, self.samples);
        let one = |k: usize| {
            let (face, j, i) = place(k, size);
            let (mut sum, mut whole) = ([0.0; 3], 0.0);
            for sample in 0..side * side {
                let at = [i * side + sample % side, j * side + sample / side];
                let [s, t] = at.map(|i| centre(i as isize, fine));
                // dw = ds dt (1 + s^2 + t^2)^(-3/2)
                let length2 = 1.0 + s * s + t * t;
                let weight = 1.0 / (length2 * length2.sqrt());
                sum = plus(sum, scaled(room.seen(room.probe, direction(face, [s, t])), weight));
                whole += weight;
            }
            scaled(sum, 1.0 / whole)
        };
        (0..6 * size * size).into_par_iter().map(one).collect()
    }

    /// The lobe about the centres of the texels of a level. The wider the lobe, the more the same
    /// rays are off by, and the fewer texels there are.
    fn prefiltered(&self, room: &Room, size: usize, alpha: f64) -> Vec<[f64; 3]> {
        let times = (self.size / size).min(MOST_TIMES) as u32;
        let rays = Rays::new(&self.kernel, alpha, self.rays.saturating_mul(times), self.seed);
        let one = |k: usize| {
            let (face, j, i) = place(k, size);
            let axis = direction(face, [i, j].map(|i| centre(i as isize, size)));
            let [x, y] = tangents(axis);
            let outlook = Outlook::new(room, room.probe, [x, y, axis]);
            let sum = rays.directions().iter().fold([0.0; 3], |sum, ray| plus(sum, outlook.seen(*ray)));
            scaled(sum, 1.0 / rays.directions().len() as f64)
        };
        (0..6 * size * size).into_par_iter().map(one).collect()
    }
}

/// Face, row and column of a texel.
fn place(k: usize, size: usize) -> (usize, usize, usize) {
    (k / (size * size), k / size % size, k % size)
}
