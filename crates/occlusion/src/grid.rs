//! A grid of binary sub-voxels, accumulated from depth and splatted into a buffer.

use crate::camera::{Camera, Place};
use crate::depth::{Depth, EMPTY};
use crate::raster::Cuboid;
use lobefit_math::subvoxel::{centroid, from_morton, morton, supervoxel_mask};

/// Voxels of 2 x 2 x 2 sub-voxels, eight of which lie in a word.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Super-voxels along each axis, powers of two.
    supers: [u32; 3],
    /// Digits of the cubes that are in Morton order; the cubes follow row by row.
    digits: u32,
    words: Vec<u64>,
    /// Words with any sub-voxel, as they came.
    occupied: Vec<u32>,
    /// Its lower corner.
    low: Place,
    /// Side of a sub-voxel along each axis, metres.
    side: Place,
}

/// Depth up to which sub-voxels are splatted one by one, and beyond which super-voxels are.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Lod {
    /// Metres.
    pub near: f32,
    /// Metres, no less.
    pub far: f32,
}

impl Grid {
    /// Of so many voxels along each axis, powers of two of at least 2, which span a box.
    pub fn new(voxels: [u32; 3], bounds: &Cuboid) -> Grid {
        let supers = voxels.map(|n| n / 2);
        let digits = supers.iter().map(|n| n.trailing_zeros()).min().unwrap_or_default();
        Grid {
            supers,
            digits,
            words: vec![0; supers.iter().map(|n| *n as usize).product()],
            occupied: Vec::new(),
            low: bounds.low,
            side: [0, 1, 2].map(|k| (bounds.high[k] - bounds.low[k]) / (2 * voxels[k]) as f32),
        }
    }

    /// The word of a super-voxel.
    fn index(&self, place: [u32; 3]) -> u32 {
        let [x, y, z] = place.map(|x| x >> self.digits);
        let [width, height, _] = self.supers.map(|n| n >> self.digits);
        let within = (1 << self.digits) - 1;
        (((z * height + y) * width + x) << (3 * self.digits)) | morton(place.map(|x| x & within))
    }

    /// The super-voxel of a word.
    fn place(&self, index: u32) -> [u32; 3] {
        let [width, height, _] = self.supers.map(|n| n >> self.digits);
        let (cube, within) =
            (index >> (3 * self.digits), from_morton(index & ((1 << (3 * self.digits)) - 1)));
        let cube = [cube % width, cube / width % height, cube / width / height];
        [0, 1, 2].map(|k| (cube[k] << self.digits) | within[k])
    }

    /// Sets the sub-voxel of a place, in which its lower borders lie; nothing outside of the grid.
    /// Whether it was set.
    pub fn set(&mut self, place: Place) -> bool {
        let at = [0, 1, 2].map(|k| (place[k] - self.low[k]) / self.side[k]);
        // Written so that what is not a number is outside.
        if !(0..3).all(|k| at[k] >= 0.0 && at[k] < (4 * self.supers[k]) as f32) {
            return false;
        }
        let at = at.map(|x| x as u32);
        let index = self.index(at.map(|x| x >> 2));
        let word = &mut self.words[index as usize];
        if *word == 0 {
            self.occupied.push(index);
        }
        *word |= 1 << (8 * morton(at.map(|x| x >> 1 & 1)) + morton(at.map(|x| x & 1)));
        true
    }

    /// Sub-voxels that are set.
    pub fn count(&self) -> u32 {
        self.occupied.iter().map(|index| self.words[*index as usize].count_ones()).sum()
    }

    /// Sets what a depth hits. Texels touched.
    pub fn accumulate(&mut self, depth: &Depth, camera: &Camera) -> u64 {
        let [corner, across, down] = camera.rays(depth.size);
        let mut touched = depth.texels.len() as u64;
        for (i, &z) in depth.texels.iter().enumerate().filter(|(_, z)| z.is_finite() && **z > 0.0) {
            let (x, y) = ((i % depth.size[0]) as f32 + 0.5, (i / depth.size[0]) as f32 + 0.5);
            let place = [0, 1, 2].map(|k| camera.eye[k] + z * (corner[k] + x * across[k] + y * down[k]));
            touched += u64::from(self.set(place));
        }
        touched
    }

    /// Writes points of the grid into the empty texels of a buffer, the nearest of those in a
    /// texel: each a square as large as what it stands for looks, and as much farther away than it
    /// is. What is nearer than its own size, the camera in it, is left out. Voxels and texels
    /// touched.
    pub fn splat(&self, camera: &Camera, lod: Lod, out: &mut Depth) -> u64 {
        let mut layer = Depth::empty(out.size);
        // Of voxels that are no cubes the longest: a square covers what it stands for.
        let side = self.side.into_iter().fold(0.0, f32::max);
        let mut touched = self.occupied.len() as u64;
        for &index in &self.occupied {
            let (word, place) = (self.words[index as usize], self.place(index));
            let low = [0, 1, 2].map(|k| self.low[k] + 4.0 * place[k] as f32 * self.side[k]);
            // A step of 4, 2 or 1 sub-voxels from a corner in these units.
            let mut point = |corner: Place, centre: Place, step: f32| {
                let at = [0, 1, 2].map(|k| low[k] + (corner[k] + step * centre[k]) * self.side[k]);
                touched += 1 + square(camera, at, step * side, &mut layer);
            };
            let middle = camera.view([0, 1, 2].map(|k| low[k] + 2.0 * self.side[k]))[2];
            if middle < -4.0 * side {
                continue;
            }
            if middle > lod.far {
                let Some(centre) = centroid(supervoxel_mask(word)) else { continue };
                point([0.0; 3], centre, 4.0);
                continue;
            }
            for (b, mask) in word.to_le_bytes().into_iter().enumerate() {
                let Some(centre) = centroid(mask) else { continue };
                let corner = [0, 1, 2].map(|k| 2.0 * (b >> k & 1) as f32);
                if middle > lod.near {
                    point(corner, centre, 2.0);
                    continue;
                }
                for bit in (0..8).filter(|bit| mask >> bit & 1 == 1) {
                    point([0, 1, 2].map(|k| corner[k] + (bit >> k & 1) as f32), [0.5; 3], 1.0);
                }
            }
        }
        for (texel, z) in out.texels.iter_mut().zip(layer.texels).filter(|(texel, _)| **texel == EMPTY) {
            *texel = z;
        }
        touched + 2 * out.texels.len() as u64
    }
}

/// Draws a square of a side in metres about a place. Texels touched.
fn square(camera: &Camera, place: Place, side: f32, out: &mut Depth) -> u64 {
    let view = camera.view(place);
    let Some(pixel) = camera.pixel(view, out.size).filter(|_| view[2] > side) else { return 0 };
    let half = 0.25 * side / view[2] / camera.tangents[0] * out.size[0] as f32;
    let ends = |k: usize| {
        let end = |x: f32| (x.max(0.0) as usize).min(out.size[k]);
        // The texels whose centres lie inside, or else the one that the place is in.
        let [first, last] = [end(pixel[k] - half + 0.5), end(pixel[k] + half + 0.5)];
        let own = pixel[k].max(0.0) as usize;
        if first < last || pixel[k] < 0.0 {
            (first, last)
        } else {
            (own.min(out.size[k]), (own + 1).min(out.size[k]))
        }
    };
    let ((left, right), (top, bottom)) = (ends(0), ends(1));
    for y in top..bottom {
        for x in left..right {
            out.nearest(x, y, view[2] + side);
        }
    }
    ((right - left) * (bottom - top)) as u64
}
