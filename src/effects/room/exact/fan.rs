//! Directions of the lobes of a kernel.

use std::f64::consts::PI;

use super::super::light::Room;
use super::super::lookup::{Fetch, Tap};
use super::outlook::Outlook;
use crate::math::ops;
use crate::math::sobol::Sobol;
use crate::math::vector::{Vec3, dot, plus, scaled, tangents};
use crate::optics::kernel::Kernel;

/// ln of the widths between which directions are tabulated, and steps between them. Below the narrowest the tangents are in proportion to
/// alpha, but for A/(1 - energy) = 1e-10 times the number of directions.
const NARROWEST: f64 = -11.5;
const STEP: f64 = 0.125;
const NODES: usize = 93;

/// The same points, of even energy and azimuth, as directions of the lobe of every width in (0, 1]: the tangent of half the angle over alpha
/// is interpolated by cubics in ln alpha, to 1e-5 of itself.
#[derive(Clone, Debug)]
pub struct Fan {
    /// Cosine and sine of the azimuth of each direction.
    azimuths: Vec<[f64; 2]>,
    /// tan(theta/2)/alpha of each direction, by node.
    tangents: Vec<Vec<f64>>,
}

impl Fan {
    /// `count` directions, a scrambled Sobol set of a seed: those of [`Rays`](super::super::Rays).
    pub fn new(kernel: Kernel, count: u32, seed: u32) -> Fan {
        let points = Sobol::new([seed, seed.wrapping_mul(0x9e37_79b9) ^ 0x5bd1_e995, 0]);
        let azimuth = |i: u32| {
            let (sine, cosine) = ops::sincos(2.0 * PI * points.coordinate(i, 1));
            [cosine, sine]
        };
        let energies: Vec<f64> = (0..count).map(|i| points.coordinate(i, 0)).collect();
        let node = |k: usize| {
            let alpha = ops::exp(NARROWEST + STEP * k as f64);
            let lobe = kernel.lobe(alpha);
            energies.iter().map(|&energy| lobe.quantile(energy).sqrt() / alpha).collect()
        };
        Fan { azimuths: (0..count).map(azimuth).collect(), tangents: (0..NODES).map(node).collect() }
    }

    /// How many directions.
    pub fn count(&self) -> usize {
        self.azimuths.len()
    }

    /// Calls `each` with the directions of the lobe of a width, about the axis z, all of the same weight.
    #[inline]
    pub fn directions(&self, alpha: f64, mut each: impl FnMut(Vec3)) {
        let (first, weights) = cubic(ops::log(alpha));
        let weights = weights.map(|w| w * alpha);
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| &self.tangents[first + k][..self.azimuths.len()]);
        for (i, [cosine, sine]) in self.azimuths.iter().enumerate() {
            let t = weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i] + weights[3] * d[i];
            let over = 1.0 / (1.0 + t * t);
            let across = 2.0 * t * over;
            each([across * cosine, across * sine, (1.0 - t * t) * over]);
        }
    }

    /// Mean radiance of the lobe of a width about `axis` from a place, without the directions below a surface's `normal` where one is given.
    pub fn lobe(&self, room: &Room, place: Vec3, axis: Vec3, normal: Option<Vec3>, alpha: f64) -> [f64; 3] {
        let [x, y] = tangents(axis);
        let frame = [x, y, axis];
        let outlook = Outlook::new(room, place, frame);
        // all directions are above a normal of no length
        let (normal, above) = match normal {
            Some(normal) => (frame.map(|axis| dot(axis, normal)), 0.0),
            None => ([0.0; 3], -1.0),
        };
        let (mut sum, mut count) = ([0.0; 3], 0_u32);
        self.directions(alpha, |towards| {
            if dot(normal, towards) > above {
                sum = plus(sum, outlook.seen(towards));
                count += 1;
            }
        });
        if count == 0 { [0.0; 3] } else { scaled(sum, 1.0 / f64::from(count)) }
    }
}

/// The first of the four nodes about a width, and their weights: Lagrange's cubic.
fn cubic(log: f64) -> (usize, [f64; 4]) {
    let x = ((log - NARROWEST) / STEP).clamp(0.0, (NODES - 1) as f64);
    let first = (x as usize).clamp(1, NODES - 3) - 1;
    let t = x - (first + 1) as f64;
    let weights = [
        -t * (t - 1.0) * (t - 2.0) / 6.0,
        (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
        -(t + 1.0) * t * (t - 2.0) / 2.0,
        (t + 1.0) * t * (t - 1.0) / 6.0,
    ];
    (first, weights)
}

/// Fetches from the probe of a room whose lobes are integrated.
#[derive(Clone, Copy, Debug)]
pub struct Exact<'a> {
    /// The room.
    pub room: &'a Room,
    /// Directions.
    pub fan: &'a Fan,
}

impl Fetch for Exact<'_> {
    fn fetch(&self, tap: &Tap) -> [f64; 3] {
        self.fan.lobe(self.room, self.room.probe, tap.towards, None, tap.alpha)
    }
}
