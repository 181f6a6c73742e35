//! How much of an error is seen: a weight over mu.
//!
//! A pixel of a sphere seen from afar shows a normal with the cosine mu to the view; those between
//! mu and mu + d mu fill the share 2 mu d mu of its disc. There a white surface of radiance Y that
//! errs by e, relative to the light that falls on it, departs by e Y, and to first order in the
//! lightness L* of FLIP's colour difference by e Y dL*/dY. The mean square of that over the pixels
//! of a sphere in the furnace (Y = 1) and of one in the environment of the studies, each with half
//! the say, is the integral of (w e)^2 over mu with
//!
//! w(mu)^2 = 2 mu (s(1)^2 + mean of s(Y)^2)/2, s(Y) = Y dL*/dY,
//!
//! the mean over the azimuths of the disc and Y the radiance of a white Lambertian sphere over that
//! of its brightest place; divided by s(1)^2, so that w = sqrt(2 mu) in the furnace alone. A least
//! squares fit with this weight (`--norm rms --weight perceptual`) so has the least mean square
//! difference in lightness; FLIP itself compresses (the power 0.7) and blurs on top of that, which
//! moves no weight between places that are seen alike. Roughness and f0 do not matter: a white
//! surface that is right is equally bright for all of them.

use std::f64::consts::PI;

mod environment;
mod irradiance;

pub use environment::{Aimed, Environment, Lamp};
pub use irradiance::diffuse_light;

use lobefit::report::luminance;
use lobefit_math::ops;

/// Steps of mu in [0, 1], and azimuths at each, at which the environment's light is averaged.
const STEPS: usize = 32;
const AZIMUTHS: usize = 32;

/// The weight of an error at a cosine of the view.
#[derive(Clone, Debug, PartialEq)]
pub struct Perceptual {
    /// Mean of (s(Y)/s(1))^2 over the azimuths, at even steps of mu.
    lit: Vec<f64>,
}

impl Default for Perceptual {
    fn default() -> Perceptual {
        Perceptual::new()
    }
}

impl Perceptual {
    /// The weight, from the light of [`Environment::afternoon`].
    pub fn new() -> Perceptual {
        let environment = Environment::afternoon();
        let light = |mu: f64, azimuth: usize| {
            let (sine, cosine) = ops::sincos(2.0 * PI * (azimuth as f64 + 0.5) / AZIMUTHS as f64);
            let radius = ((1.0 - mu) * (1.0 + mu)).sqrt();
            luminance(diffuse_light(&environment, [radius * cosine, radius * sine, mu]))
        };
        let ring = |i: usize| -> Vec<f64> {
            let mu = i as f64 / STEPS as f64;
            (0..AZIMUTHS).map(|k| light(mu, k)).collect()
        };
        let rings: Vec<Vec<f64>> = (0..=STEPS).map(ring).collect();
        let brightest = rings.iter().flatten().fold(0.0, |m: f64, y| m.max(*y));
        let square = |y: f64| {
            let s = y * sensitivity(y) / sensitivity(1.0);
            s * s
        };
        let mean =
            |ring: &Vec<f64>| ring.iter().map(|y| square(y / brightest)).sum::<f64>() / AZIMUTHS as f64;
        Perceptual { lit: rings.iter().map(mean).collect() }
    }

    /// The weight at mu in [0, 1]: 0 at 0, which no pixel shows, at most sqrt 2.
    pub fn at(&self, mu: f64) -> f64 {
        let place = mu.clamp(0.0, 1.0) * STEPS as f64;
        let i = (place.floor() as usize).min(STEPS - 1);
        let part = place - i as f64;
        let lit = self.lit[i] * (1.0 - part) + self.lit[i + 1] * part;
        (mu.max(0.0) * (1.0 + lit)).sqrt()
    }
}

/// Slope of L*'s linear foot and its end (CIE 15:2004).
const FOOT: f64 = 6.0 / 29.0;

/// Slope dL*/dY of the lightness at a relative luminance Y: how far, per unit of light, two neutral
/// pixels lie apart in the distance that FLIP's colour difference grows with. Y in [0, 1]; 903.3 at
/// 0, 38.7 at 1.
pub fn sensitivity(y: f64) -> f64 {
    if y > FOOT * FOOT * FOOT {
        let root = ops::cbrt(y);
        116.0 / (3.0 * root * root)
    } else {
        116.0 / (3.0 * FOOT * FOOT)
    }
}
