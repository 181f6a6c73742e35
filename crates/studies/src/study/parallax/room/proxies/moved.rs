//! Planes moved away, and the correction faded out.

use super::super::{Meeting, Proxy};
use super::Body;
use super::law::Law;
use lobefit_math::vector::{Vec3, minus, plus, scaled};

/// The planes, met no nearer than a least distance along the ray (Unity's `minProjectionDistance`).
/// A huge one is no correction: the looked-up direction goes to the ray's and the ratio of
/// distances to 1. Edges stay where they are.
#[derive(Clone, Debug, PartialEq)]
pub struct Pushed {
    /// The planes.
    pub body: Body,
    /// The least distance over [`Body::nearest`], at least 0.
    pub least: Law,
}

impl Proxy for Pushed {
    fn meet(&self, from: Vec3, towards: Vec3, alpha: f64) -> Option<Meeting> {
        let (distance, normal) = self.body.first(from, towards)?;
        let distance = distance.max(self.least.at(alpha) * self.body.nearest());
        Some(Meeting { distance, place: plus(from, scaled(towards, distance)), normal })
    }
}

/// The correction faded out: the ray meets the planes where it does, and what it meets is looked up
/// as seen from a place that is a share f of the way from the shading point to the probe. With s,
/// p, t and R of the rest the looked-up direction is that of (1 - f)(s - p) + t R: f = 0 is the
/// whole correction, f = 1 the ray's own direction at a ratio of distances of 1. It is the blend of
/// both directions with the weights of their lengths.
#[derive(Clone, Debug, PartialEq)]
pub struct Faded {
    /// The planes.
    pub body: Body,
    /// The share f, in [0, 1].
    pub share: Law,
}

impl Proxy for Faded {
    fn meet(&self, from: Vec3, towards: Vec3, alpha: f64) -> Option<Meeting> {
        let (distance, normal) = self.body.first(from, towards)?;
        let probe = self.body.probe();
        let apart = scaled(minus(from, probe), 1.0 - self.share.at(alpha));
        let place = plus(plus(probe, apart), scaled(towards, distance));
        Some(Meeting { distance, place, normal })
    }
}
