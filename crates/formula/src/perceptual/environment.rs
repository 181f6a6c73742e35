//! Light from far away in every direction: a sky, a ground and round lamps, radiance in linear RGB.
//!
//! Directions: x to the right, y up, z towards the viewer.

use std::f64::consts::PI;

use serde::Serialize;

use lobefit_math::ops;
use lobefit_math::vector::{Vec3, dot, normalise, plus, tangents, turned};

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
}

/// A lamp with what its directions are drawn by.
#[derive(Clone, Copy, Debug)]
pub struct Aimed {
    axis: Vec3,
    edge: f64,
    radiance: [f64; 3],
}

impl Aimed {
    /// Of a lamp.
    pub fn new(lamp: &Lamp) -> Aimed {
        Aimed { axis: normalise(lamp.towards), edge: lamp.cosine(), radiance: lamp.radiance }
    }

    /// Its radiance from a direction and the density of one drawn evenly from it, 1 over its solid
    /// angle; 0 outside.
    pub fn seen(&self, direction: Vec3) -> ([f64; 3], f64) {
        if dot(self.axis, direction) < self.edge {
            return ([0.0; 3], 0.0);
        }
        (self.radiance, 1.0 / (2.0 * PI * (1.0 - self.edge)))
    }

    /// A direction drawn evenly from two numbers in [0, 1).
    pub fn draw(&self, u: f64, v: f64) -> Vec3 {
        // 1 - z, without cancellation for a narrow cone
        let depth = v * (1.0 - self.edge);
        let (sine, (s, c)) = ((depth * (2.0 - depth)).sqrt(), ops::sincos(2.0 * PI * u));
        turned(self.axis, tangents(self.axis), [sine * c, sine * s, 1.0 - depth])
    }
}

/// Light from everywhere.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Environment {
    /// Radiance of the sky at the zenith.
    pub zenith: [f64; 3],
    /// Radiance of the sky above the horizon; between both it goes with the square root of the
    /// height y.
    pub horizon: [f64; 3],
    /// Radiance of the ground.
    pub ground: [f64; 3],
    /// Height |y| within which sky and ground blend.
    pub haze: f64,
    /// Lamps, the sun among them, added to sky and ground.
    pub lamps: Vec<Lamp>,
}

impl Environment {
    /// A clear afternoon: a low blue sky over a brown ground, a sun (3 degrees wide, so that its
    /// highlight on a smooth sphere has some pixels) at the upper right, a bright cloud behind the
    /// spheres at the left, which lights them at grazing angles.
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
        let lamps = self.lamps.iter().map(|lamp| Aimed::new(lamp).seen(direction).0);
        lamps.fold(self.sky(direction), plus)
    }

    /// The same without the lamps.
    pub fn sky(&self, direction: Vec3) -> [f64; 3] {
        let height = direction[1];
        let rise = height.max(0.0).sqrt();
        let t = ((height / self.haze + 1.0) / 2.0).clamp(0.0, 1.0);
        let above = t * t * (3.0 - 2.0 * t);
        [0, 1, 2].map(|c| {
            let sky = self.horizon[c] + (self.zenith[c] - self.horizon[c]) * rise;
            self.ground[c] + (sky - self.ground[c]) * above
        })
    }
}
