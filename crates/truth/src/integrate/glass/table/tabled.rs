//! What the kernel of tables needs of a distribution of normals, a lane at a time.

use super::lobe::Lobe;
use crate::integrate::glass::facets::Facets;
use crate::optics::beckmann::{Beckmann, falling, ierfc_near};
use crate::optics::distribution::Ggx;

/// A distribution of which glass has tables.
pub trait Tabled: Facets {
    /// Name of its quantity.
    const QUANTITY: &'static str;

    /// Lengths of panels by those of GGX.
    const PANEL: f64;

    /// More nodes of the transmission's azimuth than GGX takes.
    const AZIMUTH: f64;

    /// The projected area s of all facets about a direction.
    fn area_far(lobe: &Lobe<Self>, cosine: f64) -> f64;

    /// `l2` times that about the cosine `light`/`l2`; `l4` is l2^2.
    fn area_over(lobe: &Lobe<Self>, light: f64, l2: f64, l4: f64) -> f64;

    /// d and m of m l4^2/d^2 = pi D/a^2 at the depth 1 - h_z = `depth`/`l2`.
    fn of_ring(lobe: &Lobe<Self>, depth: f64, l2: f64, l4: f64) -> [f64; 2];

    /// Three numbers by which [`Tabled::of_light`] knows D of half vectors from the angle w on, and
    /// the S by which D has another form, where sin^2 rises by `rise` S.
    fn of_facet(lobe: &Lobe<Self>, sine: f64, cosine: f64, rise: f64) -> ([f64; 3], f64);

    /// d and m of m l2^2/d^2 = pi D/a^2, |H|^2 = 1 at S = 4 q2/l2.
    fn of_light(facet: [f64; 3], q2: f64, l2: f64) -> [f64; 2];
}

impl Tabled for Ggx {
    const QUANTITY: &'static str = "ggx-glass";
    const PANEL: f64 = 1.0;
    const AZIMUTH: f64 = 0.0;

    #[inline(always)]
    fn area_far(lobe: &Lobe<Ggx>, cosine: f64) -> f64 {
        (cosine * cosine + lobe.a2 * ((1.0 - cosine) * (1.0 + cosine))).sqrt()
    }

    #[inline(always)]
    fn area_over(lobe: &Lobe<Ggx>, light: f64, _: f64, l4: f64) -> f64 {
        (lobe.a2 * l4 + lobe.rest * light * light).sqrt()
    }

    /// a^2 + (1 - a^2) (1 - h_z^2).
    #[inline(always)]
    fn of_ring(lobe: &Lobe<Ggx>, depth: f64, l2: f64, l4: f64) -> [f64; 2] {
        [lobe.a2 * l4 + lobe.rest * depth * (2.0 * l2 - depth), 1.0]
    }

    #[inline(always)]
    fn of_facet(lobe: &Lobe<Ggx>, sine: f64, cosine: f64, rise: f64) -> ([f64; 3], f64) {
        let den = sine * sine + lobe.a2 * cosine * cosine;
        ([den, 4.0 * rise, 1.0], den / positive(rise))
    }

    #[inline(always)]
    fn of_light([den, rise, _]: [f64; 3], q2: f64, l2: f64) -> [f64; 2] {
        [den * l2 + rise * q2, 1.0]
    }
}

impl Tabled for Beckmann {
    const QUANTITY: &'static str = "beckmann-glass";
    const PANEL: f64 = 0.35;
    const AZIMUTH: f64 = 7.0;

    #[inline(always)]
    fn area_far(lobe: &Lobe<Beckmann>, cosine: f64) -> f64 {
        // The cosine of a ray refracted straight down may be one rounding above 1.
        let sine = positive((1.0 - cosine) * (1.0 + cosine)).sqrt();
        cosine + lobe.alpha * sine * ierfc_near(cosine / (lobe.alpha * sine))
    }

    #[inline(always)]
    fn area_over(lobe: &Lobe<Beckmann>, light: f64, l2: f64, _: f64) -> f64 {
        let cosine = light / l2;
        l2 * Self::area_far(lobe, if cosine < 1.0 { cosine } else { 1.0 })
    }

    #[inline(always)]
    fn of_ring(lobe: &Lobe<Beckmann>, depth: f64, l2: f64, l4: f64) -> [f64; 2] {
        let cosine = (l2 - depth) / l2;
        let over = 1.0 / (lobe.a2 * positive(cosine) * positive(cosine));
        let exponent = depth * (2.0 * l2 - depth) / l4 * over;
        [l4, over * over * falling(exponent)]
    }

    #[inline(always)]
    fn of_facet(lobe: &Lobe<Beckmann>, sine: f64, cosine: f64, rise: f64) -> ([f64; 3], f64) {
        let over = 1.0 / (lobe.a2 * positive(cosine) * positive(cosine));
        ([sine * sine * over, 4.0 * rise * over, over * over], 1.0 / positive(rise * over))
    }

    #[inline(always)]
    fn of_light([exponent, rise, scale]: [f64; 3], q2: f64, l2: f64) -> [f64; 2] {
        [l2, scale * falling(exponent + rise * q2 / l2)]
    }
}

/// Keeps divisors above 0.
#[inline(always)]
fn positive(x: f64) -> f64 {
    if x > 1e-30 { x } else { 1e-30 }
}
