//! The lookup of a cubemap through a proxy, whatever place its texels see the room from.

use super::viewpoint::{Viewpoint, to_edge};
use crate::effects::room::{Convex, Lookup, Seen, Tap};
use crate::math::ops;
use crate::math::vector::{Vec3, dot, length, minus, normalise, plus, scaled};

/// Which ratio of the shading point's view of a wall to the texel's makes a width of a width.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "lowercase", tag = "ratio")]
pub enum Ratio {
    /// Of the distances.
    Distance,
    /// The root of that of the solid angles: rho = (d_s/d_v) sqrt(cos psi_v/cos psi_s). It jumps where a ray passes from one wall to the next.
    Area,
    /// (d_s/d_v) (cos psi_v/cos psi_s)^(share/2): the distances at an edge of the proxy, the solid angles as far from any edge as `widths` radii
    /// alpha d_s of the lobe on the wall. It does not jump.
    Fading {
        /// Radii over which it changes; positive.
        widths: f64,
    },
}

/// Least cosine of a ray to a wall.
const GRAZING: f64 = 0.02;

/// Steps towards the width that a sliding viewpoint, which depends on it, asks for. Every step is a continuous function of the last.
const STEPS: usize = 4;

/// One fetch in the direction in which the probe sees what the mirror ray meets.
#[derive(Clone, Debug)]
pub struct Correction {
    /// What the room is taken for.
    pub proxy: Convex,
    /// Where the cubemap was taken.
    pub probe: Vec3,
    /// The law of its bake.
    pub viewpoint: Viewpoint,
    /// How widths change.
    pub ratio: Ratio,
    /// Width of the fetch by (alpha, rho).
    pub width: fn(f64, f64) -> f64,
}

impl Lookup for Correction {
    /// One fetch; along the mirror ray and as wide as the lobe where that meets nothing in front of the point.
    fn taps(&self, seen: &Seen) -> Vec<Tap> {
        let facing = dot(seen.normal, seen.view);
        let ray = normalise(minus(scaled(seen.normal, 2.0 * facing), seen.view));
        let uncorrected = Tap { towards: ray, alpha: seen.alpha, weight: 1.0 };
        let Some((distance, wall)) = self.proxy.exit(seen.place, ray).filter(|(t, _)| *t > 0.0) else {
            return vec![uncorrected];
        };
        let place = plus(seen.place, scaled(ray, distance));
        let from = minus(place, self.probe);
        if length(from) == 0.0 {
            return vec![uncorrected];
        }
        let here = Here { distance, cosine: dot(self.proxy.planes[wall].normal, ray).max(GRAZING), wall, place };
        vec![Tap { towards: normalise(from), alpha: self.fetched(seen.alpha, &here), weight: 1.0 }]
    }
}

/// Where the mirror ray of a shading point ends.
struct Here {
    distance: f64,
    cosine: f64,
    wall: usize,
    place: Vec3,
}

impl Correction {
    /// The width to fetch.
    fn fetched(&self, alpha: f64, here: &Here) -> f64 {
        let slides = matches!(self.viewpoint, Viewpoint::Sliding { .. });
        let normal = self.proxy.planes[here.wall].normal;
        // as if the texel saw the wall from the distance of the probe: the first step puts that right
        let mut width = alpha;
        for _ in 0..if slides { STEPS } else { 1 } {
            let eye = self.viewpoint.above(&self.proxy, self.probe, (here.place, here.wall), width);
            let distance = length(minus(here.place, eye.place));
            let share = match self.ratio {
                Ratio::Distance => 0.0,
                Ratio::Area => 1.0,
                Ratio::Fading { widths } => {
                    let radius = widths * alpha * here.distance;
                    (to_edge(&self.proxy, here.place, here.wall) / radius).clamp(0.0, 1.0)
                }
            };
            let slant = dot(normal, eye.axis).max(GRAZING) / here.cosine;
            let rho = here.distance / distance * ops::pow(slant, 0.5 * share);
            width = (self.width)(alpha, rho);
        }
        width
    }
}
