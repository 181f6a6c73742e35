//! How a wall stretches a small lobe on its way from the shading point to the probe.

use crate::effects::room::Meeting;
use crate::math::ops;
use crate::math::vector::{Vec3, dot, length, minus, plus, scaled, tangents};

/// Least cosine between a ray and the normal of a wall: below, the footprint is as long as the wall.
pub const LEAST_COSINE: f64 = 0.02;

/// The map M from directions about a ray from the shading point to directions from the probe, both to what the ray hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// s1/s2 >= 1; 1 where the lobe stays round.
    pub kappa: f64,
    /// sqrt(s1 s2) = (d_s/d_p) sqrt(cos psi_p/cos psi_s) > 0: by how much a lobe looks wider from the probe.
    pub area: f64,
    /// The direction at right angles to the ray that M lengthens most, by s1, of unit length; of its two signs the one towards which the
    /// footprint grows. Any where kappa = 1.
    pub major: Vec3,
    /// The derivative of ln(d_s/d_p) by the tangent of a tilt along `major`, >= 0. The other factor of `area` is constant over a plane, so
    /// that ln `area` grows 3/2 as fast.
    pub growth: f64,
}

impl Stretch {
    /// Of the ray of unit length from a place to what it hits, seen from a probe. Cosines with the wall's normal are at least 0.02. `None`
    /// where one of both stands in the place hit, or a length is no number.
    pub fn of(place: Vec3, hit: &Meeting, probe: Vec3) -> Option<Stretch> {
        let ray = minus(hit.place, place);
        Stretch::of_lobe(place, hit, probe, tangents(scaled(ray, 1.0 / length(ray))))
    }

    /// [`Stretch::of`] a lobe that is no round one: M after the map from a round lobe's directions to those of the lobe, whose two half-axes at
    /// right angles to the ray are `axes`, their lengths' product 1. `major` is then as long as the lobe is in its direction.
    pub fn of_lobe(place: Vec3, hit: &Meeting, probe: Vec3, axes: [Vec3; 2]) -> Option<Stretch> {
        let (from_place, from_probe) = (minus(hit.place, place), minus(hit.place, probe));
        let (near, far) = (length(from_place), length(from_probe));
        if !(near > 0.0 && far > 0.0 && near.is_finite() && far.is_finite()) {
            return None;
        }
        let (ray, seen) = (scaled(from_place, 1.0 / near), scaled(from_probe, 1.0 / far));
        let steep = dot(hit.normal, ray).max(LEAST_COSINE);
        // a tilt e moves the place hit by d_s (e - ray (n.e)/(n.ray)); across the probe's ray, by its distance, that is an angle
        let moved = axes.map(|e| scaled(minus(e, scaled(ray, dot(hit.normal, e) / steep)), near));
        let mapped = moved.map(|m| scaled(minus(m, scaled(seen, dot(seen, m))), 1.0 / far));
        let (kappa, [x, y]) = longest(mapped)?;
        let along = plus(scaled(moved[0], x), scaled(moved[1], y));
        let growth = dot(ray, along) / near - dot(seen, along) / far;
        let sign = if growth < 0.0 { -1.0 } else { 1.0 };
        Some(Stretch {
            kappa,
            area: near / far * (dot(hit.normal, seen).max(LEAST_COSINE) / steep).sqrt(),
            major: scaled(plus(scaled(axes[0], x), scaled(axes[1], y)), sign),
            growth: growth.abs(),
        })
    }
}

/// The ratio of the singular values of a map of two columns, and the unit vector that it lengthens most.
fn longest([a, b]: [Vec3; 2]) -> Option<(f64, [f64; 2])> {
    // M^T M = [[p + q, r], [r, p - q]] has the eigenvalues p +- |(q, r)|
    let (aa, bb, r) = (dot(a, a), dot(b, b), dot(a, b));
    let (p, q) = (0.5 * (aa + bb), 0.5 * (aa - bb));
    let off = (q * q + r * r).sqrt();
    let (large, least) = (p + off, p - off);
    if !(large > 0.0 && large.is_finite()) {
        return None;
    }
    // by the determinant where the difference cancels
    let small = ((aa * bb - r * r).max(0.0) / large).max(least.max(0.0)).max(large * FLATTEST * FLATTEST);
    let angle = 0.5 * ops::atan2(r, q);
    let (sine, cosine) = ops::sincos(angle);
    Some(((large / small).sqrt(), [cosine, sine]))
}

/// Least ratio of the singular values: both cosines at their least.
const FLATTEST: f64 = LEAST_COSINE * LEAST_COSINE;
