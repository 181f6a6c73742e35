//! What a GGX surface reflects.

use std::f64::consts::PI;

use super::super::light::Room;
use super::super::lookup::Seen;
use super::outlook::Outlook;
use crate::data::Smith;
use crate::math::ops;
use crate::math::sobol::Sobol;
use crate::math::vector::{dot, plus, scaled, tangents};
use crate::optics::ggx;

/// Points for visible normals: azimuth of the cap and height in it.
#[derive(Clone, Debug)]
pub struct GgxRays {
    /// Sine and cosine of the azimuth, and the height.
    points: Vec<((f64, f64), f64)>,
}

impl GgxRays {
    /// `count` points, a scrambled Sobol set of a seed.
    pub fn new(count: u32, seed: u32) -> GgxRays {
        let points = Sobol::new([seed, seed.wrapping_mul(0x9e37_79b9) ^ 0x5bd1_e995, 0]);
        let point = |i| (ops::sincos(2.0 * PI * points.coordinate(i, 0)), points.coordinate(i, 1));
        GgxRays { points: (0..count).map(point).collect() }
    }

    /// The light of a room that a GGX surface (height-correlated Smith, no Fresnel) reflects towards the eye over its own albedo, which a
    /// split sum multiplies by afterwards. By importance sampling of visible normals, whose weight is G2/G1; the surface lies where its normal
    /// says, whatever wall is there.
    pub fn reflected(&self, room: &Room, seen: &Seen) -> [f64; 3] {
        let [x, y] = tangents(seen.normal);
        let frame = [x, y, seen.normal];
        let outlook = Outlook::new(room, seen.place, frame);
        let view = frame.map(|axis| dot(axis, seen.view));
        let (mut sum, mut whole) = ([0.0; 3], 0.0);
        for &(azimuth, height) in &self.points {
            let normal = ggx::visible_normal_at([seen.alpha; 2], view, azimuth, height);
            let (light, _) = ggx::mirror(view, normal);
            if light[2] > 0.0 {
                let weight = ggx::lit_given_visible(Smith::Correlated, seen.alpha, view[2], light[2]);
                sum = plus(sum, scaled(outlook.seen(light), weight));
                whole += weight;
            }
        }
        if whole > 0.0 { scaled(sum, 1.0 / whole) } else { [0.0; 3] }
    }
}
