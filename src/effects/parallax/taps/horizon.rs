//! The fetches of a rule where some of their rays leave below the surface.
//!
//! A ray whose cosine with the surface's normal is c keeps the share f = clamp(c/[`FADE`], 0, 1) of
//! its weight w, is tilted f times as far, and is as wide as mix(1, width, f) lobes: between the
//! lobe's own ray and its own it never is below the surface. With S the sum of w f and g = min(1,
//! S/[`LEAST`]) it weighs (1 - g) w + w f/max(S, LEAST), and these weights sum to 1. Above FADE
//! nothing changes; where nothing is left, S = 0, all fetches are the lobe's own one. All of it is
//! continuous in c.

use lobefit_math::vector::{Vec3, dot, normalise, plus, scaled};
use lobefit_truth::optics::footprint::RuleTap;

/// Cosine to the surface's normal below which a fetch loses weight: three degrees above the
/// surface.
pub const FADE: f64 = 0.05;

/// Share of the weight that must be left for the rest to be weighted up alone.
pub const LEAST: f64 = 0.25;

/// Fades the fetches of a lobe about `axis`, tilted along `major`, both of unit length and at right
/// angles, over a surface of that unit `normal`. Weights must sum to 1, and do so after. A single
/// fetch along the axis stays as it is.
pub fn fade(taps: &mut [RuleTap], axis: Vec3, major: Vec3, normal: Vec3) {
    if taps.len() < 2 {
        return;
    }
    let kept = |tap: &RuleTap| {
        let ray = normalise(plus(axis, scaled(major, tap.tilt)));
        (dot(ray, normal) / FADE).clamp(0.0, 1.0)
    };
    let kept: Vec<f64> = taps.iter().map(kept).collect();
    let whole: f64 = taps.iter().zip(&kept).map(|(tap, kept)| tap.weight * kept).sum();
    let ruled = (whole / LEAST).min(1.0);
    for (tap, kept) in taps.iter_mut().zip(kept) {
        tap.tilt *= kept;
        tap.width = 1.0 + kept * (tap.width - 1.0);
        tap.weight *= 1.0 - ruled + kept / whole.max(LEAST);
    }
}
