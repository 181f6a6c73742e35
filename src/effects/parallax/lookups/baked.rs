//! The lookup of a chain whose texels see the room from elsewhere than the probe.

use super::{Shading, Width};
use crate::effects::room::cubemap::{Viewpoint, to_edge};
use crate::effects::room::{Convex, Lookup, Seen, Tap};
use crate::math::ops;
use crate::math::vector::{Vec3, dot, length, minus, normalise, plus, scaled};

/// The power of the cosines in the ratio of the shading point's view of a wall to the texel's, rho = (d_s/d_v) (cos psi_v/cos psi_s)^(share/2).
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "lowercase", tag = "slant")]
pub enum Slant {
    /// 0: the ratio of the distances, continuous where a ray passes from one wall to the next.
    Ignored,
    /// 1: the root of the ratio of the solid angles. It jumps there.
    Whole,
    /// From 0 at an edge of the proxy to 1 as far from any as `widths` radii alpha d_s of the lobe on the wall. It does not jump.
    Fading {
        /// Radii over which it changes; positive.
        widths: f64,
    },
}

/// Least cosine of a ray to a wall: that of [`Stretch`](super::super::Stretch).
const GRAZING: f64 = 0.02;

/// Steps towards the width that a sliding viewpoint, which depends on it, asks for. Every step is a continuous function of the last.
const STEPS: usize = 4;

/// One fetch in the direction in which the probe sees what the lobe's axis meets.
#[derive(Clone, Debug)]
pub struct Baked {
    /// What the room is taken for, by the bake as well.
    pub proxy: Convex,
    /// Where the cubemap was taken.
    pub probe: Vec3,
    /// What the lobe is taken for.
    pub shading: Shading,
    /// The law of the bake.
    pub viewpoint: Viewpoint,
    /// How the slants of both rays enter.
    pub slant: Slant,
    /// Which width is fetched.
    pub width: Width,
}

impl Lookup for Baked {
    /// One fetch; along the lobe's axis and as wide as it where that meets nothing in front of the point, or the probe itself.
    fn taps(&self, seen: &Seen) -> Vec<Tap> {
        let lobe = self.shading.lobe(seen);
        let uncorrected = Tap { towards: lobe.axis, alpha: lobe.alpha, weight: 1.0 };
        let Some((distance, wall)) = self.proxy.exit(seen.place, lobe.axis).filter(|(t, _)| *t > 0.0) else {
            return vec![uncorrected];
        };
        let place = plus(seen.place, scaled(lobe.axis, distance));
        let from = minus(place, self.probe);
        if length(from) == 0.0 {
            return vec![uncorrected];
        }
        let cosine = dot(self.proxy.planes[wall].normal, lobe.axis).max(GRAZING);
        let alpha = self.fetched(lobe.alpha, &End { distance, cosine, wall, place });
        vec![Tap { towards: normalise(from), alpha, weight: 1.0 }]
    }
}

/// Where the axis of a lobe ends.
struct End {
    distance: f64,
    cosine: f64,
    wall: usize,
    place: Vec3,
}

impl Baked {
    /// The width to fetch for a lobe of a width.
    fn fetched(&self, alpha: f64, end: &End) -> f64 {
        let slides = matches!(self.viewpoint, Viewpoint::Sliding { .. });
        let normal = self.proxy.planes[end.wall].normal;
        let share = match self.slant {
            Slant::Ignored => 0.0,
            Slant::Whole => 1.0,
            Slant::Fading { widths } => {
                let radius = widths * alpha * end.distance;
                (to_edge(&self.proxy, end.place, end.wall) / radius).clamp(0.0, 1.0)
            }
        };
        // as if the texel saw the wall from as far as the point does: the first step puts that right
        let mut width = alpha;
        for _ in 0..if slides { STEPS } else { 1 } {
            let eye = self.viewpoint.above(&self.proxy, self.probe, (end.place, end.wall), width);
            let slant = dot(normal, eye.axis).max(GRAZING) / end.cosine;
            let rho = end.distance / length(minus(end.place, eye.place)) * ops::pow(slant, 0.5 * share);
            width = self.width.of(alpha, rho);
        }
        width
    }
}
