//! Old depth as points, forward into a buffer of the camera of now.

use crate::camera::{Camera, NEAR, dot};
use crate::depth::Depth;

/// From the pixels of an old camera into the view of a new one: the view of a pixel at depth z is
/// t + z (a + x b + y c).
struct Carried {
    a: [f32; 3],
    b: [f32; 3],
    c: [f32; 3],
    t: [f32; 3],
    scale: [f32; 2],
    size: [usize; 2],
    /// Texels around the buffer.
    margin: usize,
}

impl Carried {
    fn new(from: &Camera, old: [usize; 2], to: &Camera, size: [usize; 2]) -> Carried {
        let [a, b, c] = from.rays(old).map(|ray| to.axes.map(|axis| dot(axis, ray)));
        let scale = [0, 1].map(|k| 0.5 * size[k] as f32 / to.tangents[k]);
        Carried { a, b, c, t: to.view(from.eye), scale, size, margin: 0 }
    }

    /// The column, row and depth of a pixel centre at depth z; of an infinite depth those of its
    /// direction.
    fn at(&self, x: usize, y: usize, z: f32) -> Option<([f32; 2], f32)> {
        let (x, y) = (x as f32 + 0.5, y as f32 + 0.5);
        let ray = [0, 1, 2].map(|k| self.a[k] + x * self.b[k] + y * self.c[k]);
        let far = z == f32::INFINITY;
        let view = if far { ray } else { [0, 1, 2].map(|k| self.t[k] + z * ray[k]) };
        // A direction has no near plane, and must point ahead.
        if view[2] < if far { 1e-6 } else { NEAR } {
            return None;
        }
        let [w, h] = self.size.map(|n| n as f32);
        let at = [0.5 * w + view[0] / view[2] * self.scale[0], 0.5 * h + view[1] / view[2] * self.scale[1]];
        Some((at, if far { z } else { view[2] }))
    }

    /// The texel of a place, inside of the buffer with its margin.
    fn texel(&self, at: [f32; 2]) -> Option<usize> {
        let [x, y] = at.map(|x| x + self.margin as f32);
        let [width, height] = self.size.map(|n| n + 2 * self.margin);
        let inside = x >= 0.0 && y >= 0.0 && x < width as f32 && y < height as f32;
        inside.then(|| y as usize * width + x as usize)
    }
}

/// Writes every texel of an old depth where it is seen from now: of two in a texel the nearer
/// counts, and what is infinitely far only where nothing else is. Texels touched.
pub fn reproject(old: &Depth, from: &Camera, to: &Camera, out: &mut Depth) -> u64 {
    let carried = Carried::new(from, old.size, to, out.size);
    let mut touched = old.texels.len() as u64;
    for (i, &z) in old.texels.iter().enumerate() {
        let Some((at, z)) = carried.at(i % old.size[0], i / old.size[0], z) else { continue };
        if carried.texel(at).is_some() {
            out.nearest(at[0] as usize, at[1] as usize, z);
            touched += 1;
        }
    }
    touched
}

/// Largest part of 1/z by which its second difference may be off a plane's: rounding, and no edge.
const PLANE: f32 = 2e-3;

/// The same so that nothing is hidden that is seen: the farthest point counts, and between
/// neighbours that no plane joins nothing is known, for behind an edge a gap may have opened.
/// Texels next to one that is not known are not either, the ones around the frame among them.
/// Texels touched.
pub fn reproject_conservatively(old: &Depth, from: &Camera, to: &Camera, out: &mut Depth) -> u64 {
    let carried = Carried { margin: 1, ..Carried::new(from, old.size, to, out.size) };
    let [width, height] = old.size;
    let mut wide = Depth::empty(out.size.map(|n| n + 2));
    let mut touched = old.texels.len() as u64;
    let mut points = Vec::with_capacity(old.texels.len());
    for (i, &z) in old.texels.iter().enumerate() {
        let point = carried.at(i % width, i / width, z);
        points.push(point);
        if let Some((texel, z)) = point.and_then(|(at, z)| Some((carried.texel(at)?, z))) {
            wide.texels[texel] = wide.texels[texel].max(z);
            touched += 1;
        }
    }
    let inverse = |i: usize| 1.0 / old.texels[i];
    // Of a texel, the step to its neighbour, and whether one lies before it and one behind that.
    let mut opened = |i: usize, step: usize, before: bool, behind: bool| {
        let (a, b) = (inverse(i), inverse(i + step));
        // On a plane the step is that before and that behind.
        let on_plane = |x: f32, y: f32, z: f32| (x - 2.0 * y + z).abs() <= PLANE * y.max(x).max(z);
        let joined =
            before && on_plane(inverse(i - step), a, b) || behind && on_plane(a, b, inverse(i + 2 * step));
        if joined {
            return;
        }
        // Beside a place that is behind the camera its own alone is known.
        let ends = [points[i].or(points[i + step]), points[i + step].or(points[i])];
        if let [Some((p, _)), Some((q, _))] = ends {
            let length = (p[0] - q[0]).abs().max((p[1] - q[1]).abs());
            let steps = (2.0 * length).ceil().clamp(1.0, 4096.0) as usize;
            for s in 0..=steps {
                let t = s as f32 / steps as f32;
                if let Some(texel) = carried.texel([0, 1].map(|k| p[k] + t * (q[k] - p[k]))) {
                    wide.texels[texel] = f32::INFINITY;
                    touched += 1;
                }
            }
        }
    };
    for y in 0..height {
        for x in 0..width {
            if x + 1 < width {
                opened(y * width + x, 1, x > 0, x + 2 < width);
            }
            if y + 1 < height {
                opened(y * width + x, width, y > 0, y + 2 < height);
            }
        }
    }
    let wide = wide.eroded(1);
    for (row, texels) in out.texels.chunks_exact_mut(out.size[0]).enumerate() {
        texels.copy_from_slice(&wide.texels[(row + 1) * wide.size[0] + 1..][..texels.len()]);
    }
    touched + 9 * wide.texels.len() as u64
}
