//! Planes whose edges are rounded by the width of the lobe.

use super::super::lookup::{Meeting, Proxy};
use super::body::Body;
use lobefit_math::vector::{Vec3, dot, length, plus, scaled};

/// The planes with smooth edges.
///
/// Inverse distances along the ray, s_i = n_i.R/h_i, are joined one by one. Of the largest so far
/// and the next, a and b, with m = max(a, b) and the rounding k the joined one is
///
///   m - k + sqrt(max(a - m + k, 0)^2 + max(b - m + k, 0)^2),
///
/// m itself where the other is smaller by k or more, and the root of a^2 + b^2 where k = m. Its
/// gradient gives the normal: continuous, also where a plane comes ahead (s_i = 0), as k <= m.
/// Turning the ray by an angle e changes s_i by n_i.e/h_i: a lobe that is alpha wide reaches over
/// alpha/h_i of it, so that k = min([`Eased::REACH`] alpha max(1/h_a, 1/h_b), m) is what it reaches
/// over at the edge. 1/h_a of planes that are joined is the largest of theirs, each by its part;
/// the normal is the gradient at a fixed k.
#[derive(Clone, Debug, PartialEq)]
pub struct Eased {
    /// The planes.
    pub body: Body,
}

impl Eased {
    /// Widths of the lobe that an edge is rounded over. Of 0.8, 1.2, 1.7 and 2.4, and of powers of
    /// alpha between 0.75 and 1.25, this leaves the least creases on edges in pictures of three
    /// rooms at an error within 1 % of that of the p-norm that was used before.
    pub const REACH: f64 = 1.2;

    /// The least [`Eased::bend`]: edges of a mirror are rounded by less than is seen.
    pub const LEAST: f64 = 0.003;

    /// How far edges are rounded, over the largest nearness.
    pub fn bend(alpha: f64) -> f64 {
        (Eased::REACH * alpha).max(Eased::LEAST)
    }

    /// That in a shader's arithmetic on f32.
    pub fn source(alpha: &str) -> String {
        format!("max({:?} * {alpha}, {:?})", Eased::REACH as f32, Eased::LEAST as f32)
    }

    /// What an edge is rounded over, in a formula of the width of the lobe.
    pub fn formula(width: &str) -> String {
        format!("min({} {width} max(1/h_i, 1/h_j), max(1/t_i, 1/t_j))", Eased::REACH)
    }
}

impl Proxy for Eased {
    fn meet(&self, from: Vec3, towards: Vec3, alpha: f64) -> Option<Meeting> {
        let bend = Eased::bend(alpha);
        let (mut both, mut close, mut normal) = (0.0_f64, 0.0_f64, [0.0; 3]);
        for plane in self.body.ahead(from, towards) {
            let near = 1.0 / plane.depth;
            let along = plane.approach * near;
            let top = both.max(along);
            let base = top - (bend * close.max(near)).min(top);
            let [over, ahead] = [both, along].map(|s| (s - base).max(0.0));
            let joined = (over * over + ahead * ahead).sqrt();
            both = base + joined;
            close = (over * close).max(ahead * near) / joined;
            normal = scaled(plus(scaled(normal, over), scaled(plane.normal, ahead * near)), 1.0 / joined);
        }
        if both == 0.0 {
            return None;
        }
        let distance = 1.0 / both;
        let place = plus(from, scaled(towards, distance));
        debug_assert!(dot(normal, towards) > 0.0);
        Some(Meeting { distance, place, normal: scaled(normal, 1.0 / length(normal)) })
    }
}
