//! The planes about a probe.

use super::super::lookup::{Meeting, Proxy};
use super::super::shape::{Convex, Plane};
use lobefit_math::vector::{Vec3, dot, plus, scaled};

/// Least distance of a plane from a shading point, in the scene's unit of length: nothing is
/// divided by 0, and ratios of distances that are certified begin far above it.
pub const NEAREST: f64 = 1e-5;

/// A convex body with a probe inside. As a proxy it is met on its planes: continuous, with a kink
/// in the looked-up direction and a jump in the normal at its edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    planes: Vec<Plane>,
}

/// A plane as a ray from a shading point has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facing {
    /// Its normal.
    pub normal: Vec3,
    /// Its distance from the shading point on either side, at least [`NEAREST`].
    pub depth: f64,
    /// Cosine between ray and normal.
    pub approach: f64,
}

impl Body {
    /// The body of planes about a probe; `None` where the probe is not inside all of them, by a
    /// finite distance.
    pub fn new(shape: &Convex, probe: Vec3) -> Option<Body> {
        let mut heights = shape.planes.iter().map(|plane| plane.depth(probe));
        heights.all(|h| h > 0.0 && h.is_finite()).then(|| Body { planes: shape.planes.clone() })
    }

    /// The planes that a ray goes towards.
    pub fn ahead(&self, from: Vec3, towards: Vec3) -> impl Iterator<Item = Facing> {
        let facing = self.planes.iter().map(move |plane| Facing {
            normal: plane.normal,
            depth: plane.depth(from).abs().max(NEAREST),
            approach: dot(plane.normal, towards),
        });
        facing.filter(|plane| plane.approach > 0.0)
    }

    /// Distance and normal of the first plane that a ray meets.
    pub fn first(&self, from: Vec3, towards: Vec3) -> Option<(f64, Vec3)> {
        let distances = self.ahead(from, towards).map(|plane| (plane.depth / plane.approach, plane.normal));
        distances.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

impl Proxy for Body {
    fn meet(&self, from: Vec3, towards: Vec3, _alpha: f64) -> Option<Meeting> {
        let (distance, normal) = self.first(from, towards)?;
        Some(Meeting { distance, place: plus(from, scaled(towards, distance)), normal })
    }
}
