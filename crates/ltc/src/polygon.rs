//! The share of a cosine's light that a polygon sends: Lambert's closed form, clipped to the
//! horizon, and the two ways in which shaders do without the clipping.

use lobefit_math::ops;
use lobefit_math::vector::{Vec3, cross, dot, length, minus, normalise, plus, scaled};
use std::f64::consts::PI;

/// The part of a polygon above z = 0.
fn clipped(corners: &[Vec3]) -> Vec<Vec3> {
    let mut above = Vec::with_capacity(corners.len() + 1);
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        if a[2] > 0.0 {
            above.push(a);
        }
        if (a[2] > 0.0) != (b[2] > 0.0) {
            above.push(plus(a, scaled(minus(b, a), a[2] / (a[2] - b[2]))));
        }
    }
    above
}

/// The vector form factor over pi of a polygon of any corners but 0: its length is the share of
/// the light that it sends to a surface that faces it, its z the share of one that faces z where
/// all of the polygon is above the horizon (Lambert 1760; Arvo 1994).
pub fn vector_share(corners: &[Vec3]) -> Vec3 {
    let unit: Vec<Vec3> = corners.iter().map(|corner| normalise(*corner)).collect();
    let mut sum = [0.0; 3];
    for (i, &a) in unit.iter().enumerate() {
        let across = cross(a, unit[(i + 1) % unit.len()]);
        let sine = length(across);
        if sine > 0.0 {
            let angle = ops::atan2(sine, dot(a, unit[(i + 1) % unit.len()]));
            sum = plus(sum, scaled(across, angle / sine));
        }
    }
    scaled(sum, 0.5 / PI)
}

/// The share of a cosine's light within a polygon, exactly, whichever way round its corners go.
pub fn cosine_share(corners: &[Vec3]) -> f64 {
    let above = clipped(corners);
    if above.len() < 3 { 0.0 } else { vector_share(&above)[2].abs() }
}

/// The share of a sphere with the vector form factor of a polygon, exactly: the fourth channel
/// of the second texture holds it divided by the length, at columns of the cosine of its direction
/// and rows of the length.
pub fn sphere_share(cosine: f64, length: f64) -> f64 {
    let length = length.clamp(0.0, 1.0);
    let (sine, sine2) = (length.sqrt(), length);
    let cosine = cosine.clamp(-1.0, 1.0);
    let across = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    // How the cap of half angle sigma lies to the horizon.
    if cosine >= sine || length == 0.0 {
        return length * cosine.max(0.0);
    }
    if cosine <= -sine {
        return 0.0;
    }
    let reach = (1.0 - sine2).sqrt();
    let g = ops::asin((reach / across).min(1.0));
    let (sin_g, cos_g) = (reach / across, ops::cos(g));
    let g_part = -2.0 * across * reach * cos_g + 0.5 * PI - g + sin_g.min(1.0) * cos_g;
    let root = (sine2 - cos_g * cos_g).max(0.0).sqrt();
    let h_part = cosine * (cos_g * root + sine2 * ops::asin((cos_g / sine).min(1.0)));
    let share = if cosine >= 0.0 { PI * cosine * sine2 + g_part - h_part } else { g_part + h_part };
    share / PI
}

/// The same by the formula of shaders that fetch nothing for it.
pub fn proxy_share(vector: Vec3) -> f64 {
    let length = length(vector);
    ((length * length + vector[2]) / (length + 1.0)).max(0.0)
}
