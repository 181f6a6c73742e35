//! Lobes integrated in a room: without texels, levels or faces of a cubemap.

use std::f64::consts::PI;

use super::light::Room;
use super::lookup::Tap;
use crate::math::ops;
use crate::math::sobol::Sobol;
use crate::math::vector::{Vec3, dot, plus, scaled, tangents, turned};
use crate::optics::kernel::Kernel;

/// Directions about the axis z drawn by the energy of a lobe, each of the same weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Rays {
    directions: Vec<Vec3>,
}

impl Rays {
    /// `count` directions of the lobe of a kernel and a width in (0, 1], a scrambled Sobol set of a seed.
    pub fn new(kernel: Kernel, alpha: f64, count: u32, seed: u32) -> Rays {
        let lobe = kernel.lobe(alpha);
        let points = Sobol::new([seed, seed.wrapping_mul(0x9e37_79b9) ^ 0x5bd1_e995, 0]);
        let direction = |i: u32| {
            let u = lobe.quantile(points.coordinate(i, 0));
            let (sine, cosine) = (2.0 * u.sqrt() / (1.0 + u), (1.0 - u) / (1.0 + u));
            let (s, c) = ops::sincos(2.0 * PI * points.coordinate(i, 1));
            [sine * c, sine * s, cosine]
        };
        Rays { directions: (0..count).map(direction).collect() }
    }

    /// The directions, about z.
    pub fn directions(&self) -> &[Vec3] {
        &self.directions
    }
}

/// Mean radiance over a lobe about `axis` from a place, without the directions below a surface's `normal` where one is given.
pub fn lobe(room: &Room, place: Vec3, axis: Vec3, normal: Option<Vec3>, rays: &Rays) -> [f64; 3] {
    let frame = tangents(axis);
    let (mut sum, mut count) = ([0.0; 3], 0_u32);
    for local in &rays.directions {
        let towards = turned(axis, frame, *local);
        if normal.is_none_or(|normal| dot(normal, towards) > 0.0) {
            sum = plus(sum, room.seen(place, towards));
            count += 1;
        }
    }
    if count == 0 { [0.0; 3] } else { scaled(sum, 1.0 / f64::from(count)) }
}

/// What fetches from the room's probe give, each lobe integrated by the rays that `rays` has for its width.
pub fn fetched(room: &Room, taps: &[Tap], rays: impl Fn(f64) -> Rays) -> [f64; 3] {
    taps.iter().fold([0.0; 3], |sum, tap| {
        let light = lobe(room, room.probe, tap.towards, None, &rays(tap.alpha));
        plus(sum, scaled(light, tap.weight))
    })
}
