//! Which points of a sphere a pixel sees, from afar and along z.

use lobefit_math::vector::{Vec3, cross, dot, normalise, plus, scaled, tangents};

/// Places per pixel and axis where the sphere's edge passes.
const EDGE: usize = 4;

/// The direction to the viewer.
const VIEW: Vec3 = [0.0, 0.0, 1.0];

/// A point of a sphere: its normal, with tangents such that the view lies in the plane of the
/// first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    axes: [Vec3; 3],
    /// The direction to the viewer about the normal.
    pub view: Vec3,
}

impl Place {
    /// The place at (x, y) of a sphere of radius 1, none beside it; y up.
    fn at(x: f64, y: f64) -> Option<Place> {
        let square = x * x + y * y;
        if square >= 1.0 {
            return None;
        }
        let normal = [x, y, (1.0 - square).sqrt()];
        let mu = normal[2];
        let across = [-x * mu, -y * mu, square];
        let first = if square > 0.0 { normalise(across) } else { tangents(normal)[0] };
        let view = [square.sqrt(), 0.0, mu];
        debug_assert!((dot(first, VIEW) - view[0]).abs() < 1e-9);
        Some(Place { axes: [first, cross(normal, first), normal], view })
    }

    /// A direction about the normal, in the environment.
    pub fn outward(&self, local: Vec3) -> Vec3 {
        let [a, b, n] = self.axes;
        plus(plus(scaled(a, local[0]), scaled(b, local[1])), scaled(n, local[2]))
    }

    /// A direction of the environment, about the normal.
    pub fn inward(&self, direction: Vec3) -> Vec3 {
        self.axes.map(|axis| dot(axis, direction))
    }
}

/// The places that a pixel sees, and how many were looked for.
pub(super) struct Pixel {
    pub places: Vec<Place>,
    pub taken: usize,
}

/// The pixel at (column, row) of a square of `side` pixels with a sphere of `radius` pixels in its
/// middle.
pub(super) fn pixel(column: usize, row: usize, side: usize, radius: f64) -> Pixel {
    let centre = side as f64 / 2.0;
    let (x, y) = (column as f64 + 0.5 - centre, centre - row as f64 - 0.5);
    let n = if ((x * x + y * y).sqrt() - radius).abs() < 1.0 { EDGE } else { 1 };
    let offset = |k: usize| (k as f64 + 0.5) / n as f64 - 0.5;
    let all = (0..n * n).map(|k| ((x + offset(k % n)) / radius, (y + offset(k / n)) / radius));
    Pixel { places: all.filter_map(|(x, y)| Place::at(x, y)).collect(), taken: n * n }
}
