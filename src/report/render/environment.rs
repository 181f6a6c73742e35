//! Light from far away in every direction: a sky, a ground and round lamps, radiance in linear RGB.
//!
//! Directions: x to the right, y up, z towards the viewer.

use std::f64::consts::PI;

use serde::Serialize;

use super::directions::cone;
use super::{dot, normalise, plus, scaled, tangents};
use crate::math::ops;
use crate::optics::ggx::Vec3;

/// A round light at infinity: the same radiance within an angle about a direction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Lamp {
    /// Where it stands; any length but 0.
    pub towards: Vec3,
    /// Angle between its centre and its edge, degrees in (0, 90].
    pub degrees: f64,
    /// Radiance.
    pub radiance: [f64; 3],
}

impl Lamp {
    /// Cosine of its half angle.
    pub(super) fn cosine(&self) -> f64 {
        ops::cos(self.degrees * PI / 180.0)
    }

    /// Density of a direction drawn evenly from it: 1 over its solid angle, 0 outside.
    pub(super) fn density(&self, direction: Vec3) -> f64 {
        let edge = self.cosine();
        if dot(normalise(self.towards), direction) < edge { 0.0 } else { 1.0 / (2.0 * PI * (1.0 - edge)) }
    }

    /// A direction drawn evenly from two numbers in [0, 1).
    pub(super) fn draw(&self, u: f64, v: f64) -> Vec3 {
        let axis = normalise(self.towards);
        let [a, b] = tangents(axis);
        let local = cone(self.cosine(), u, v);
        plus(plus(scaled(a, local[0]), scaled(b, local[1])), scaled(axis, local[2]))
    }
}

/// Light from everywhere.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Environment {
    /// Radiance of the sky at the zenith.
    pub zenith: [f64; 3],
    /// Radiance of the sky above the horizon; between both it goes with the square root of the height y.
    pub horizon: [f64; 3],
    /// Radiance of the ground.
    pub ground: [f64; 3],
    /// Height |y| within which sky and ground blend.
    pub haze: f64,
    /// Lamps, the sun among them, added to sky and ground.
    pub lamps: Vec<Lamp>,
}

impl Environment {
    /// A clear afternoon: a low blue sky over a brown ground, a sun (3 degrees wide, so that its highlight on a smooth sphere has
    /// some pixels) at the upper right, a bright cloud behind the spheres at the left, which lights them at grazing angles.
    pub fn afternoon() -> Environment {
        Environment {
            zenith: [0.10, 0.20, 0.44],
            horizon: [0.46, 0.52, 0.58],
            ground: [0.13, 0.10, 0.07],
            haze: 0.1,
            lamps: vec![
                Lamp { towards: [0.55, 0.65, 0.55], degrees: 3.0, radiance: [700.0, 630.0, 520.0] },
                Lamp { towards: [-0.85, 0.3, -0.35], degrees: 16.0, radiance: [5.0, 5.3, 6.0] },
            ],
        }
    }

    /// Radiance 1 from everywhere: the furnace.
    pub fn furnace() -> Environment {
        let white = [1.0; 3];
        Environment { zenith: white, horizon: white, ground: white, haze: 0.1, lamps: Vec::new() }
    }

    /// Radiance from a direction of unit length.
    pub fn radiance(&self, direction: Vec3) -> [f64; 3] {
        let height = direction[1];
        let rise = height.max(0.0).sqrt();
        let t = ((height / self.haze + 1.0) / 2.0).clamp(0.0, 1.0);
        let above = t * t * (3.0 - 2.0 * t);
        let mut light = [0, 1, 2].map(|c| {
            let sky = self.horizon[c] + (self.zenith[c] - self.horizon[c]) * rise;
            self.ground[c] + (sky - self.ground[c]) * above
        });
        for lamp in self.lamps.iter().filter(|lamp| lamp.density(direction) > 0.0) {
            light = plus(light, lamp.radiance);
        }
        light
    }
}
