//! Boxes tested against a depth buffer.

use crate::camera::{Camera, NEAR};
use crate::depth::Depth;
use crate::raster::Cuboid;

/// What a test says of a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Behind the camera or beside the frame: not drawn, whatever the buffer holds.
    Outside,
    /// It is, or may be, seen.
    Kept,
    /// All of its rectangle is hidden.
    Culled,
}

/// What a box covers of a buffer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// First and last column and row.
    columns: [usize; 2],
    rows: [usize; 2],
    /// Depth of its nearest corner.
    nearest: f32,
}

impl Footprint {
    /// The rectangle of a box; a verdict where it has none: [`Verdict::Kept`] where it meets the
    /// near plane or its corners are not finite. A box without area has the rectangle of one texel.
    pub fn of(camera: &Camera, cuboid: &Cuboid, size: [usize; 2]) -> Result<Footprint, Verdict> {
        let corners: [_; 8] = std::array::from_fn(|i| camera.view(cuboid.corner(i)));
        if corners.iter().flatten().any(|x| !x.is_finite()) {
            return Err(Verdict::Kept);
        }
        let depths = corners.map(|corner| corner[2]);
        let nearest = depths.into_iter().fold(f32::INFINITY, f32::min);
        if depths.into_iter().all(|z| z < NEAR) {
            return Err(Verdict::Outside);
        }
        if nearest < NEAR {
            return Err(Verdict::Kept);
        }
        let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for pixel in corners.iter().filter_map(|corner| camera.pixel(*corner, size)) {
            for k in 0..2 {
                (low[k], high[k]) = (low[k].min(pixel[k]), high[k].max(pixel[k]));
            }
        }
        if (0..2).any(|k| high[k] < 0.0 || low[k] >= size[k] as f32) {
            return Err(Verdict::Outside);
        }
        let ends = [0, 1].map(|k| [low[k].max(0.0) as usize, (high[k] as usize).min(size[k] - 1)]);
        Ok(Footprint { columns: ends[0], rows: ends[1], nearest })
    }

    /// The least part by which the depths of a buffer have to be taken for farther so that the box is
    /// kept: 0 where it is kept as they are. Empty texels hide nothing.
    pub fn margin(&self, depth: &Depth) -> f32 {
        let mut farthest = 0.0_f32;
        for y in self.rows[0]..=self.rows[1] {
            let row = &depth.texels[y * depth.size[0]..][self.columns[0]..=self.columns[1]];
            farthest = f32::from_bits(row.iter().fold(farthest.to_bits(), |far, z| far.max(z.to_bits())));
            // Empty texels and what is not a number have the largest bits: written so that they hide
            // nothing.
            if !(farthest >= 0.0 && farthest < self.nearest) {
                return 0.0;
            }
        }
        self.nearest / farthest - 1.0
    }

    /// Whether a buffer hides all of it, its depths taken for farther by the part `bias`.
    pub fn is_hidden(&self, depth: &Depth, bias: f32) -> bool {
        self.margin(depth) > bias
    }
}

/// What a buffer says of a box.
pub fn test(depth: &Depth, camera: &Camera, cuboid: &Cuboid, bias: f32) -> Verdict {
    match Footprint::of(camera, cuboid, depth.size) {
        Err(verdict) => verdict,
        Ok(footprint) if footprint.is_hidden(depth, bias) => Verdict::Culled,
        Ok(_) => Verdict::Kept,
    }
}
