//! Planes blended by the p-norm of their distances.

use super::super::{Meeting, Proxy};
use super::law::Law;
use super::{Body, blended};
use lobefit_math::vector::Vec3;

/// The planes blended ([`blended`]) by a power that follows the width of the lobe.
#[derive(Clone, Debug, PartialEq)]
pub struct Smooth {
    /// The planes.
    pub body: Body,
    /// The power, above 1.
    pub power: Law,
}

impl Smooth {
    /// A power by alpha alone that was once fitted for the smallest relative L2 error of one fetch,
    /// over all roughnesses and three rooms. The least of 2 keeps the normal continuous where a
    /// plane comes ahead.
    pub const FITTED: Law = Law::Inverse { over: 0.39, power: 1.5, least: 2.0, most: 256.0 };

    /// The power of the study, by eye: max(4, 0.6/alpha). Above 256 nothing changes that is seen.
    pub const BY_EYE: Law = Law::Inverse { over: 0.6, power: 1.0, least: 4.0, most: 256.0 };
}

impl Proxy for Smooth {
    fn meet(&self, from: Vec3, towards: Vec3, alpha: f64) -> Option<Meeting> {
        blended(&self.body, from, towards, self.power.at(alpha))
    }
}
