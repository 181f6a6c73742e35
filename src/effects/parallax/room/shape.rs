//! Convex bodies by their planes.

use lobefit_math::vector::{Vec3, cross, dot, normalise, plus, scaled};

/// A plane: the half-space normal . x <= offset is inside.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Plane {
    /// Unit normal, outward.
    pub normal: Vec3,
    /// Distance of the plane from the origin along the normal.
    pub offset: f64,
}

impl Plane {
    /// The plane of a normal of any length but 0 through a place.
    pub fn through(place: Vec3, normal: Vec3) -> Plane {
        let normal = normalise(normal);
        Plane { normal, offset: dot(normal, place) }
    }

    /// How far inside a place lies; negative outside.
    pub fn depth(&self, place: Vec3) -> f64 {
        self.offset - dot(self.normal, place)
    }
}

/// The intersection of half-spaces, with the origin of coordinates anywhere.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Convex {
    /// Its planes; enough of them to be bounded.
    pub planes: Vec<Plane>,
}

impl Convex {
    /// A box between two corners: the planes -x, x, -y, y, -z, z.
    pub fn cuboid(low: Vec3, high: Vec3) -> Convex {
        let pair = |axis: usize| {
            let mut normal = [0.0; 3];
            normal[axis] = 1.0;
            [
                Plane { normal: normal.map(|x: f64| -x), offset: -low[axis] },
                Plane { normal, offset: high[axis] },
            ]
        };
        Convex { planes: (0..3).flat_map(pair).collect() }
    }

    /// Where a ray from `from` leaves it: the distance in units of the length of `towards`, and the
    /// plane. `None` for a ray that leaves through no plane. From outside a plane that the ray
    /// recedes from, the distance is negative.
    pub fn exit(&self, from: Vec3, towards: Vec3) -> Option<(f64, usize)> {
        let mut exit: Option<(f64, usize)> = None;
        for (i, plane) in self.planes.iter().enumerate() {
            let approach = dot(plane.normal, towards);
            if approach > 0.0 {
                let t = plane.depth(from) / approach;
                if exit.is_none_or(|(nearest, _)| t < nearest) {
                    exit = Some((t, i));
                }
            }
        }
        exit
    }

    /// Its corners, each once for every three of its planes that meet there.
    pub fn corners(&self) -> Vec<Vec3> {
        let planes = &self.planes;
        let mut corners = Vec::new();
        for (i, a) in planes.iter().enumerate() {
            for (j, b) in planes.iter().enumerate().skip(i + 1) {
                corners.extend(planes[j + 1..].iter().filter_map(|c| meet([a, b, c])));
            }
        }
        corners.retain(|&corner| planes.iter().all(|plane| plane.depth(corner) >= -CORNER));
        corners
    }
}

/// How far outside a plane a corner may lie by rounding, in metres.
const CORNER: f64 = 1e-9;

/// The place that three planes share; none where two of them are parallel, or nearly so.
fn meet([a, b, c]: [&Plane; 3]) -> Option<Vec3> {
    let sides = [cross(b.normal, c.normal), cross(c.normal, a.normal), cross(a.normal, b.normal)];
    let volume = dot(a.normal, sides[0]);
    let sum = plus(plus(scaled(sides[0], a.offset), scaled(sides[1], b.offset)), scaled(sides[2], c.offset));
    (volume.abs() > 1e-9).then(|| scaled(sum, 1.0 / volume))
}
