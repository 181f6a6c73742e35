//! Chains made from a room.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::chain::trilinear;
use super::faces::{centre, direction, interval, solid_angle};
use super::{Chain, CubemapError, Edges, Format, Level, Viewpoint};
use crate::study::parallax::room::{Convex, Fan, Outlook, Rays, Room};
use lobefit::data::MipChain;
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, plus, scaled, tangents, turned};
use lobefit_truth::optics::kernel::Kernel;

/// Most rays of a texel over those of the first level's.
const MOST_TIMES: usize = 16;

/// What the prefiltered levels are made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// The room itself: the texel is the integral of the lobe about its centre.
    Room,
    /// The captured faces, as engines have them: rays of the lobe, each fetched from a box-filtered
    /// level of the capture whose texels are as large as the ray's share of the lobe (Colbert and
    /// Krivanek 2007, "GPU-Based Importance Sampling"). From the probe only.
    Capture,
}

/// How a chain is made.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Bake {
    /// The lobe of a level.
    pub kernel: Kernel,
    /// Levels and their roughness; alpha = roughness^2.
    pub map: MipChain,
    /// Texels along a side of a face of the first level; each further level has half of them.
    pub size: usize,
    /// Bits of a channel.
    pub format: Format,
    /// Reading at the edges of faces.
    pub edges: Edges,
    /// Made from what.
    pub source: Source,
    /// From where.
    pub viewpoint: Viewpoint,
    /// Samples along a side of a texel of a level of roughness 0 and of a capture: the mean
    /// radiance over the texel's solid angle by the midpoint rule, off by about their power -3/2 of
    /// the contrast where an edge of the room's pattern crosses.
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
    /// A size that cannot be halved as often as there are levels; no samples; radiance that the
    /// format has no number for.
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
        let pyramid = match self.source {
            Source::Room => Vec::new(),
            Source::Capture => pyramid(self.captured(room, self.size), self.size)?,
        };
        let proxy = room.shape();
        let level = |i: usize| {
            let size = self.size >> i;
            let roughness = self.map.roughness(i as f64);
            let alpha = roughness * roughness;
            let texels = match self.source {
                _ if alpha == 0.0 => self.captured(room, size),
                Source::Room => self.integrated(room, &proxy, size, alpha),
                Source::Capture => self.filtered(&pyramid, size, alpha),
            };
            Level::new(size, &texels, self.format)
        };
        let levels = (0..levels).map(level).collect::<Result<Vec<_>, _>>()?;
        Chain::new(self.map.clone(), levels, self.edges)
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

    /// The lobe about the centres of the texels of a level.
    fn integrated(&self, room: &Room, proxy: &Convex, size: usize, alpha: f64) -> Vec<[f64; 3]> {
        if self.viewpoint == Viewpoint::Probe {
            return self.angular(room, size, alpha);
        }
        let fan = Fan::new(&self.kernel, self.rays_of(size), self.seed);
        let one = |k: usize| {
            let eye = self.viewpoint.eye(proxy, room.probe, towards(k, size), alpha);
            fan.lobe(room, eye.place, eye.axis, None, eye.alpha)
        };
        (0..6 * size * size).into_par_iter().map(one).collect()
    }

    /// All lobes from the probe: of one width.
    fn angular(&self, room: &Room, size: usize, alpha: f64) -> Vec<[f64; 3]> {
        let rays = Rays::new(&self.kernel, alpha, self.rays_of(size), self.seed);
        let one = |k: usize| {
            let axis = towards(k, size);
            let [x, y] = tangents(axis);
            let outlook = Outlook::new(room, room.probe, [x, y, axis]);
            let sum = rays.directions().iter().fold([0.0; 3], |sum, ray| plus(sum, outlook.seen(*ray)));
            scaled(sum, 1.0 / rays.directions().len() as f64)
        };
        (0..6 * size * size).into_par_iter().map(one).collect()
    }

    /// Rays of a texel of a level: the wider its lobe, the more the same rays are off by, and the
    /// fewer texels it has.
    fn rays_of(&self, size: usize) -> u32 {
        let times = (self.size / size).min(MOST_TIMES) as u32;
        self.rays.saturating_mul(times)
    }

    /// The same from a capture's levels.
    fn filtered(&self, pyramid: &[Level], size: usize, alpha: f64) -> Vec<[f64; 3]> {
        let lobe = self.kernel.lobe(alpha);
        let texel = 4.0 * PI / (6 * self.size * self.size) as f64;
        let rays = Rays::new(&self.kernel, alpha, self.rays_of(size), self.seed);
        let count = rays.directions().len() as f64;
        let level = |ray: &Vec3| {
            let density = lobe.per_solid_angle((1.0 - ray[2]) / (1.0 + ray[2]));
            // at the horizon the density may be 0: the last level of all
            (*ray, 0.5 * ops::log2(1.0 / (count * density * texel)))
        };
        let levels: Vec<(Vec3, f64)> = rays.directions().iter().map(level).collect();
        let one = |k: usize| {
            let axis = towards(k, size);
            let frame = tangents(axis);
            let sum = levels.iter().fold([0.0; 3], |sum, (ray, level)| {
                plus(sum, trilinear(pyramid, turned(axis, frame, *ray), *level, Edges::Seamless))
            });
            scaled(sum, 1.0 / levels.len() as f64)
        };
        (0..6 * size * size).into_par_iter().map(one).collect()
    }
}

/// Face, row and column of a texel.
fn place(k: usize, size: usize) -> (usize, usize, usize) {
    (k / (size * size), k / size % size, k % size)
}

/// Direction of the centre of a texel.
fn towards(k: usize, size: usize) -> Vec3 {
    let (face, j, i) = place(k, size);
    direction(face, [i, j].map(|i| centre(i as isize, size)))
}

/// A capture and its halves, each texel the mean of four weighted by their solid angles, as long as
/// the size is even.
fn pyramid(captured: Vec<[f64; 3]>, size: usize) -> Result<Vec<Level>, CubemapError> {
    let mut levels = vec![Level::new(size, &captured, Format::Single)?];
    let (mut texels, mut size) = (captured, size);
    while size % 2 == 0 {
        texels = halved(&texels, size);
        size /= 2;
        levels.push(Level::new(size, &texels, Format::Single)?);
    }
    Ok(levels)
}

fn halved(texels: &[[f64; 3]], size: usize) -> Vec<[f64; 3]> {
    let half = size / 2;
    let one = |k: usize| {
        let (face, j, i) = place(k, half);
        let (mut sum, mut whole) = ([0.0; 3], 0.0);
        for (di, dj) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let (i, j) = (2 * i + di, 2 * j + dj);
            let weight = solid_angle(interval(i, size), interval(j, size));
            sum = plus(sum, scaled(texels[(face * size + j) * size + i], weight));
            whole += weight;
        }
        scaled(sum, 1.0 / whole)
    };
    (0..6 * half * half).map(one).collect()
}
