//! Planes blended by the p-norm of their distances.

use super::super::lookup::{Meeting, Proxy};
use super::body::Body;
use super::law::Law;
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, normalise, plus, scaled};

/// A body that a ray meets at t = (sum t_i^-p)^(-1/p), t_i the distances along the ray of the planes ahead: a smooth body about the
/// shading point inside the planes, which it nears as p grows. With x = t R the body is g(x) = (sum (n_i.x/h_i)^p)^(1/p) = 1, h_i the
/// planes' distances from the shading point, and its normal the gradient, along sum (t/t_i)^(p-1) n_i/h_i. Where a plane comes
/// ahead its term starts as the p-th power of the cosine, in the normal as the (p-1)-th: of a whole p the distance has p - 1 continuous
/// derivatives, the normal p - 2.
///
/// All terms are scaled by the nearest plane's, so that no power overflows: a term is at most 1, p may be any finite number above 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Smooth {
    /// The planes.
    pub body: Body,
    /// The power, above 1.
    pub power: Law,
}

impl Smooth {
    /// A power by alpha alone that was once fitted for the smallest relative L2 error of one fetch, over all roughnesses and three rooms. The least
    /// of 2 keeps the normal continuous where a plane comes ahead.
    pub const FITTED: Law = Law::Inverse { over: 0.39, power: 1.5, least: 2.0, most: 256.0 };

    /// The power of the study, by eye: max(4, 0.6/alpha). Above 256 nothing changes that is seen.
    pub const BY_EYE: Law = Law::Inverse { over: 0.6, power: 1.0, least: 4.0, most: 256.0 };
}

impl Proxy for Smooth {
    fn meet(&self, from: Vec3, towards: Vec3, alpha: f64) -> Option<Meeting> {
        blended(&self.body, from, towards, self.power.at(alpha))
    }
}

/// Where a ray meets the planes blended by a power.
pub(super) fn blended(body: &Body, from: Vec3, towards: Vec3, power: f64) -> Option<Meeting> {
    let ahead = || body.ahead(from, towards);
    // inverse distances: none is divided by a cosine that may be 0
    let steepest = ahead().map(|plane| plane.approach / plane.depth).reduce(f64::max)?;
    let (mut sum, mut normal) = (0.0, [0.0; 3]);
    for plane in ahead() {
        let share = plane.approach / plane.depth / steepest;
        let weight = ops::pow(share, power - 1.0);
        sum += weight * share;
        // n_i/h_i, in units of the steepest
        normal = plus(normal, scaled(plane.normal, weight / (plane.depth * steepest)));
    }
    let distance = 1.0 / (steepest * ops::pow(sum, 1.0 / power));
    let place = plus(from, scaled(towards, distance));
    Some(Meeting { distance, place, normal: normalise(normal) })
}
