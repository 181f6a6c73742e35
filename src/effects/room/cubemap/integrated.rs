//! Lobes of any width integrated in a room.

use std::f64::consts::PI;

use super::viewpoint::Viewpoint;
use crate::effects::room::{Convex, Fetch, Room, Tap};
use crate::math::ops;
use crate::math::sobol::Sobol;
use crate::math::vector::{Vec3, dot, plus, scaled, tangents, turned};
use crate::optics::kernel::Kernel;

/// Fetches without texels or levels. The rays are those of the lobe `half` of the same width, whose quantile is u = A e/(1 + A - e),
/// weighted to the kernel: no equation is solved for a width.
#[derive(Clone, Debug)]
pub struct Integrated<'a> {
    room: &'a Room,
    shape: Convex,
    kernel: Kernel,
    viewpoint: Viewpoint,
    /// Energy within the cone through a ray, sine and cosine of its azimuth.
    points: Vec<[f64; 3]>,
}

impl<'a> Integrated<'a> {
    /// Fetches from where a bake sees the room, with `count` rays of a scrambled Sobol set.
    pub fn new(
        room: &'a Room,
        kernel: Kernel,
        viewpoint: Viewpoint,
        count: u32,
        seed: u32,
    ) -> Integrated<'a> {
        let sobol = Sobol::new([seed, seed.wrapping_mul(0x9e37_79b9) ^ 0x85eb_ca6b, 0]);
        let point = |i: u32| {
            let (s, c) = ops::sincos(2.0 * PI * sobol.coordinate(i, 1));
            [sobol.coordinate(i, 0), s, c]
        };
        Integrated { room, shape: room.shape(), kernel, viewpoint, points: (0..count).map(point).collect() }
    }

    /// Mean radiance over the lobe of a width in (0, 1] about `axis` from a place, without the directions below a surface's `normal`
    /// where one is given; 0 where all are below.
    pub fn lobe(&self, place: Vec3, axis: Vec3, alpha: f64, normal: Option<Vec3>) -> [f64; 3] {
        let (frame, a2) = (tangents(axis), alpha * alpha);
        let (wanted, drawn) = (self.kernel.lobe(alpha), Kernel::Half.lobe(alpha));
        let (mut sum, mut whole) = ([0.0; 3], 0.0);
        for [energy, s, c] in &self.points {
            let u = a2 * energy / (1.0 + a2 - energy);
            let (sine, cosine) = (2.0 * u.sqrt() / (1.0 + u), (1.0 - u) / (1.0 + u));
            let towards = turned(axis, frame, [sine * c, sine * s, cosine]);
            if normal.is_none_or(|normal| dot(normal, towards) > 0.0) {
                let weight = wanted.per_solid_angle(u) / drawn.per_solid_angle(u);
                sum = plus(sum, scaled(self.room.seen(place, towards), weight));
                whole += weight;
            }
        }
        if whole > 0.0 { scaled(sum, 1.0 / whole) } else { sum }
    }
}

impl Fetch for Integrated<'_> {
    fn fetch(&self, tap: &Tap) -> [f64; 3] {
        let eye = self.viewpoint.eye(&self.shape, self.room.probe, tap.towards, tap.alpha);
        self.lobe(eye.place, eye.axis, tap.alpha, None)
    }
}
