//! A rasteriser of boxes along the axes and of triangles, exact at pixel centres up to rounding: on
//! a plane 1/z is linear over the picture.

use crate::camera::{Camera, NEAR, Place, dot};
use crate::depth::Depth;

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// Its corner of least coordinates.
    pub low: Place,
    /// Its corner of largest coordinates.
    pub high: Place,
}

/// What is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solids {
    /// Boxes, of which the faces are seen that look at the camera.
    pub boxes: Vec<Cuboid>,
    /// Triangles, seen from both sides; of one without area, or that is seen from its edge, nothing
    /// is drawn.
    pub triangles: Vec<[Place; 3]>,
}

impl Solids {
    /// Boxes alone.
    pub fn of(boxes: &[Cuboid]) -> Solids {
        Solids { boxes: boxes.to_vec(), triangles: Vec::new() }
    }
}

/// A polygon of at most four corners, cut by the near plane at most once.
struct Polygon {
    points: [[f32; 2]; 5],
    count: usize,
    /// Least and largest 1/z of its corners.
    inverse: [f32; 2],
}

impl Cuboid {
    /// About a place of its base, so wide along x and y, and so high.
    pub fn on([x, y, z]: Place, [width, depth, height]: Place) -> Cuboid {
        Cuboid {
            low: [x - 0.5 * width, y - 0.5 * depth, z],
            high: [x + 0.5 * width, y + 0.5 * depth, z + height],
        }
    }

    /// Corner i: bits 0, 1, 2 of i choose the end along x, y, z.
    pub fn corner(&self, i: usize) -> Place {
        [0, 1, 2].map(|k| if i >> k & 1 == 1 { self.high[k] } else { self.low[k] })
    }
}

/// Corners of the face at the lower (0) or upper (1) end of an axis, round about.
fn face(cuboid: &Cuboid, axis: usize, end: usize) -> [Place; 4] {
    let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
    [0, u, u | v, v].map(|i| cuboid.corner(i | end << axis))
}

/// Corners in the view, cut at the near plane, in pixels.
fn projected(camera: &Camera, corners: &[Place], size: [usize; 2]) -> Polygon {
    let mut view = [[0.0; 3]; 4];
    view.iter_mut().zip(corners).for_each(|(out, corner)| *out = camera.view(*corner));
    let view = &view[..corners.len()];
    let mut out = Polygon { points: [[0.0; 2]; 5], count: 0, inverse: [f32::INFINITY, 0.0] };
    let mut put = |p: Place| {
        // On the near plane rounding may lie on either side.
        let z = p[2].max(NEAR);
        if let Some(pixel) = camera.pixel([p[0], p[1], z], size) {
            out.points[out.count] = pixel;
            out.count += 1;
            out.inverse = [out.inverse[0].min(1.0 / z), out.inverse[1].max(1.0 / z)];
        }
    };
    for (i, &a) in view.iter().enumerate() {
        let b = view[(i + 1) % view.len()];
        if a[2] >= NEAR {
            put(a);
        }
        if (a[2] >= NEAR) != (b[2] >= NEAR) {
            // From the end in front: both neighbours of an edge cut it at the same place.
            let (a, b) = if a[2] >= NEAR { (a, b) } else { (b, a) };
            let t = (NEAR - a[2]) / (b[2] - a[2]);
            put([0, 1, 2].map(|k| a[k] + t * (b[k] - a[k])));
        }
    }
    out
}

/// Columns of a row whose centres lie in a convex polygon: first, and behind the last.
fn span(polygon: &Polygon, row: usize, width: usize) -> (usize, usize) {
    let y = row as f32 + 0.5;
    let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
    for i in 0..polygon.count {
        let (a, b) = (polygon.points[i], polygon.points[(i + 1) % polygon.count]);
        if (a[1] <= y) != (b[1] <= y) {
            // From the upper end: between neighbours of an edge no pixel is left.
            let (a, b) = if a[1] < b[1] { (a, b) } else { (b, a) };
            let x = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            (low, high) = (low.min(x), high.max(x));
        }
    }
    (from(low, width), from(high, width))
}

/// The first pixel along an axis whose centre is not below x; the nearest end where all or no pixels are.
fn from(x: f32, count: usize) -> usize {
    let x = (x - 0.5).max(0.0).min(count as f32);
    let below = x as usize;
    below + usize::from((below as f32) < x)
}

/// Calls `draw` for each row of a polygon: row, columns, 1/z at the first column and its step;
/// `inverse` is 1/z at the corner of pixel 0 and its steps across and down.
fn scan(
    polygon: &Polygon,
    size: [usize; 2],
    inverse: [f32; 3],
    mut draw: impl FnMut(usize, (usize, usize), [f32; 2]),
) {
    let all = &polygon.points[..polygon.count];
    let rows = all.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), p| (l.min(p[1]), h.max(p[1])));
    for y in from(rows.0, size[1])..from(rows.1, size[1]) {
        let (left, right) = span(polygon, y, size[0]);
        if left < right {
            let start = inverse[0] + inverse[2] * (y as f32 + 0.5) + inverse[1] * (left as f32 + 0.5);
            draw(y, (left, right), [start, inverse[1]]);
        }
    }
}

/// Calls `draw` for each row of each face that the camera is in front of: row, columns, 1/z at the
/// first column and its step. A box that holds the camera has none.
pub fn faces(
    camera: &Camera,
    cuboid: &Cuboid,
    size: [usize; 2],
    mut draw: impl FnMut(usize, (usize, usize), [f32; 2]),
) {
    let rays = camera.rays(size);
    for axis in 0..3 {
        let ends = [cuboid.low[axis] - camera.eye[axis], cuboid.high[axis] - camera.eye[axis]];
        let seen = [ends[0] > 0.0, ends[1] < 0.0];
        let Some(end) = seen.iter().position(|seen| *seen) else { continue };
        // The distance along the axis over that of the ray: 1/z.
        let inverse = rays.map(|ray| ray[axis] / ends[end]);
        scan(&projected(camera, &face(cuboid, axis, end), size), size, inverse, &mut draw);
    }
}

/// A triangle in pixels, with its 1/z as of [`scan`]; none without area or seen from its edge.
fn triangle(camera: &Camera, corners: &[Place; 3], size: [usize; 2]) -> Option<(Polygon, [f32; 3])> {
    let away = |from: Place, to: Place| [0, 1, 2].map(|k| to[k] - from[k]);
    let (u, v) = (away(corners[0], corners[1]), away(corners[0], corners[2]));
    let normal = [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
    let distance = dot(normal, away(camera.eye, corners[0]));
    let inverse = camera.rays(size).map(|ray| dot(normal, ray) / distance);
    inverse.iter().all(|x| x.is_finite()).then(|| (projected(camera, corners, size), inverse))
}

/// The depth of solids.
pub fn rendered(camera: &Camera, solids: &Solids, size: [usize; 2]) -> Depth {
    let mut inverse = vec![0.0_f32; size[0] * size[1]];
    let mut put = |ends: [f32; 2], y: usize, (first, last): (usize, usize), [start, step]: [f32; 2]| {
        for (i, texel) in inverse[y * size[0] + first..y * size[0] + last].iter_mut().enumerate() {
            *texel = texel.max((start + step * i as f32).clamp(ends[0], ends[1]));
        }
    };
    for cuboid in solids.boxes.iter().filter(|cuboid| is_ahead(camera, cuboid)) {
        faces(camera, cuboid, size, |y, columns, line| put([0.0, f32::INFINITY], y, columns, line));
    }
    for (polygon, plane) in solids.triangles.iter().filter_map(|corners| triangle(camera, corners, size)) {
        // Nearly from its edge the plane is rounding: no pixel is nearer or farther than a corner.
        scan(&polygon, size, plane, |y, columns, line| put(polygon.inverse, y, columns, line));
    }
    Depth { size, texels: inverse.into_iter().map(|x| 1.0 / x).collect() }
}

/// Whether any corner lies beyond the near plane: nothing else can be drawn.
fn is_ahead(camera: &Camera, cuboid: &Cuboid) -> bool {
    let ahead = camera.axes[2];
    let far = [0, 1, 2].map(|k| if ahead[k] > 0.0 { cuboid.high[k] } else { cuboid.low[k] });
    dot(ahead, [0, 1, 2].map(|k| far[k] - camera.eye[k])) >= NEAR
}

/// Whether a box would be seen at any pixel centre in front of a depth.
pub fn is_seen(camera: &Camera, cuboid: &Cuboid, depth: &Depth) -> bool {
    let mut seen = false;
    faces(camera, cuboid, depth.size, |y, (first, last), [start, step]| {
        let texels = &depth.texels[y * depth.size[0] + first..y * depth.size[0] + last];
        seen |= texels.iter().enumerate().any(|(i, z)| (start + step * i as f32) * z > 1.0);
    });
    seen
}
