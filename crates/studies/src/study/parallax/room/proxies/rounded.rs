//! Planes with rounded edges.

use super::super::{Meeting, Proxy};
use super::law::Law;
use super::{Body, NEAREST};
use lobefit_math::vector::{Vec3, normalise, plus, scaled};

/// The body {x: sum max(0, n_i.x - o_i + r)^2 <= r^2}, o_i the planes' offsets: of a box the box
/// with edges and corners rounded by the radius r, its Minkowski offset from the box that is
/// smaller by r on all sides. Of other planes it is not an offset (whose edges and corners would
/// have to be known) but the same sum, which is convex, keeps the planes' middles where one term
/// alone is above 0, and has a continuous normal: edges at a right angle are rounded by arcs of
/// radius r, others by arcs of ellipses.
///
/// The distance is the larger root of a convex function along the ray, by Newton's method from the
/// planes inward: no step passes it. For a shading point outside the rounded body, which is near an
/// edge, the radius of the sum is a little more than its own ([`NEAREST`] of the unit), as far as
/// the planes allow.
#[derive(Clone, Debug, PartialEq)]
pub struct Rounded {
    /// The planes.
    pub body: Body,
    /// The radius over [`Body::nearest`], in [0, 1].
    pub radius: Law,
}

/// Newton's steps: from the planes the error falls quadratically; along a wall, where the root is
/// double, by a half.
const STEPS: usize = 24;

/// The sum at a place on the ray.
struct Level {
    /// Its root.
    value: f64,
    /// Half its derivative along the ray.
    slope: f64,
    /// Half its gradient.
    gradient: Vec3,
}

impl Rounded {
    fn level(&self, from: Vec3, towards: Vec3, distance: f64, radius: f64) -> Level {
        let (mut sum, mut slope, mut gradient) = (0.0, 0.0, [0.0; 3]);
        for plane in self.body.facing(from, towards) {
            let excess = radius - plane.depth + distance * plane.approach;
            if excess > 0.0 {
                sum += excess * excess;
                slope += excess * plane.approach;
                gradient = plus(gradient, scaled(plane.normal, excess));
            }
        }
        Level { value: sum.sqrt(), slope, gradient }
    }
}

impl Proxy for Rounded {
    fn meet(&self, from: Vec3, towards: Vec3, alpha: f64) -> Option<Meeting> {
        let (mut distance, mut normal) = self.body.first(from, towards)?;
        let unit = self.body.nearest();
        let radius = self.radius.at(alpha) * unit;
        let own = self.level(from, towards, 0.0, radius).value;
        let wanted = radius.max(own + NEAREST * unit);
        for _ in 0..STEPS {
            let level = self.level(from, towards, distance, radius);
            if level.slope > 0.0 {
                normal = normalise(level.gradient);
            }
            let beyond = level.value - wanted;
            // the sum is convex and less than wanted at the shading point: it rises where it is
            // more
            if beyond <= 1e-13 * wanted || level.slope <= 0.0 {
                break;
            }
            distance -= beyond * level.value / level.slope;
        }
        Some(Meeting { distance, place: plus(from, scaled(towards, distance)), normal })
    }
}
