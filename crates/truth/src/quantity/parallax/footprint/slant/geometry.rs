//! Where shading point and probe stand.

use std::f64::consts::PI;

use super::QUANTITY;
use crate::integrate::IntegrateError;
use crate::optics::footprint::{Hit, Stretch};
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, scaled};

/// A place before the wall.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Stand {
    /// From the place that is looked at, in [1e-3, 1e3].
    pub distance: f64,
    /// Angle between the ray to that place and the wall's normal, in radians, in [0, 86 degrees].
    pub slant: f64,
}

/// A shading point and a probe that look at the same place of a wall.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Slant {
    /// The shading point.
    pub shading: Stand,
    /// The probe.
    pub probe: Stand,
    /// Between the planes of both slants, in radians, in [-pi, pi]; at 0 both stand on the same
    /// side.
    pub azimuth: f64,
}

/// Largest slant: beyond, most of a lobe misses the wall.
pub const LARGEST_SLANT: f64 = 86.0 * PI / 180.0;

/// Distances.
const DISTANCES: [f64; 2] = [1e-3, 1e3];

impl Slant {
    /// Both in distance 1 of the place, the probe in front of it, the shading point at a slant in
    /// radians.
    pub fn in_front(slant: f64) -> Slant {
        let (shading, probe) = (Stand { distance: 1.0, slant }, Stand { distance: 1.0, slant: 0.0 });
        Slant { shading, probe, azimuth: 0.0 }
    }

    /// Whether it is within the domain.
    ///
    /// # Errors
    /// A distance, slant or azimuth outside of its domain or no number.
    pub fn check(&self) -> Result<(), IntegrateError> {
        let of_stand = |Stand { distance, slant }: Stand| {
            let within =
                [(DISTANCES[0]..=DISTANCES[1]).contains(&distance), (0.0..=LARGEST_SLANT).contains(&slant)];
            [
                ("distance", distance, within[0], "is outside [1e-3, 1e3]"),
                ("slant", slant, within[1], "is outside [0, 86 degrees], in radians"),
            ]
        };
        let turned = ("azimuth", self.azimuth, (-PI..=PI).contains(&self.azimuth), "is outside [-pi, pi]");
        let stands = [self.shading, self.probe].into_iter().flat_map(of_stand);
        IntegrateError::outside(QUANTITY, stands.chain([turned]))
    }

    /// Whether one half of the wall mirrors the other: both slants lie in one plane.
    pub fn mirrored(&self) -> bool {
        self.probe.slant == 0.0 || self.shading.slant == 0.0 && self.azimuth == 0.0 || {
            let (sine, _) = ops::sincos(self.azimuth);
            sine.abs() < 1e-12
        }
    }

    /// Where the shading point is.
    pub fn place(&self) -> Vec3 {
        self.shading.place(0.0)
    }

    /// Where the probe is.
    pub fn probe_place(&self) -> Vec3 {
        self.probe.place(self.azimuth)
    }

    /// The axis of the shading point's lobe.
    pub fn ray(&self) -> Vec3 {
        scaled(self.place(), -1.0 / self.shading.distance)
    }

    /// How the wall stretches a lobe of a width about the axis; `None` nowhere within the domain.
    pub fn stretch(&self, alpha: f64) -> Option<Stretch> {
        Stretch::of_round(self.place(), Hit { place: [0.0; 3], normal: OUTWARD }, self.probe_place(), alpha)
    }
}

/// The wall's normal, away from shading point and probe.
pub(super) const OUTWARD: Vec3 = [0.0, 0.0, -1.0];

impl Stand {
    fn place(self, azimuth: f64) -> Vec3 {
        let ((s, c), (y, x)) = (ops::sincos(self.slant), ops::sincos(azimuth));
        [-self.distance * s * x, -self.distance * s * y, self.distance * c]
    }
}
