//! Directions drawn about the axis z from two numbers in [0, 1).

use std::f64::consts::PI;

use lobefit_math::ops;
use lobefit_truth::optics::ggx::Vec3;

/// Density cosine/pi.
pub(super) fn cosine(u: f64, v: f64) -> Vec3 {
    turned(v.sqrt(), (1.0 - v).sqrt(), u)
}

/// Evenly within the cone whose edge has the cosine `edge`.
pub(super) fn cone(edge: f64, u: f64, v: f64) -> Vec3 {
    // 1 - z, without cancellation for a narrow cone.
    let depth = v * (1.0 - edge);
    turned((depth * (2.0 - depth)).sqrt(), 1.0 - depth, u)
}

fn turned(sine: f64, cosine: f64, u: f64) -> Vec3 {
    let (s, c) = ops::sincos(2.0 * PI * u);
    [sine * c, sine * s, cosine]
}
