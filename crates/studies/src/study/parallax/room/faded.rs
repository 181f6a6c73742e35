//! A ratio of solid angles that becomes one of distances at the edges of a proxy, so that it does
//! not jump there.

use crate::study::parallax::room::cubemap::to_edge;
use crate::study::parallax::room::{Convex, Lookup, Seen, Tap};
use lobefit::effects::parallax::{Ratio, Shading, Width};
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, length, minus, plus, scaled};
use lobefit_truth::optics::footprint::slant_ratio;

/// The power of the cosines in the ratio of the shading point's view of a wall to the probe's,
/// rho = (d_s/d_p) (cos psi_p/cos psi_s)^(share/2).
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "lowercase", tag = "slant")]
pub enum Slant {
    /// 0: the ratio of the distances, continuous where a ray passes from one wall to the next.
    Ignored,
    /// 1: the root of the ratio of the solid angles. It jumps there.
    Whole,
    /// From 0 at an edge of the proxy to 1 as far from any as `widths` radii alpha d_s of the lobe
    /// on the wall. It does not jump.
    Fading {
        /// Radii over which it changes; positive.
        widths: f64,
    },
}

/// One fetch in the direction in which the probe sees what the lobe's axis meets.
#[derive(Clone, Debug)]
pub struct Faded {
    /// What the room is taken for.
    pub proxy: Convex,
    /// Where the cubemap was taken.
    pub probe: Vec3,
    /// What the lobe is taken for.
    pub shading: Shading,
    /// How the slants of both rays enter.
    pub slant: Slant,
    /// Which width is fetched.
    pub width: Width,
}

impl Lookup for Faded {
    /// One fetch; along the lobe's axis and as wide as it where that meets nothing in front of the
    /// point, or the probe itself.
    fn taps(&self, seen: &Seen) -> Vec<Tap> {
        let lobe = self.shading.lobe(seen);
        let uncorrected = Tap { towards: lobe.axis, alpha: lobe.alpha, weight: 1.0 };
        let Some((distance, wall)) = self.proxy.exit(seen.place, lobe.axis).filter(|(t, _)| *t > 0.0) else {
            return vec![uncorrected];
        };
        let place = plus(seen.place, scaled(lobe.axis, distance));
        let from = minus(place, self.probe);
        let far = length(from);
        if far == 0.0 {
            return vec![uncorrected];
        }
        let towards = scaled(from, 1.0 / far);
        let share = match self.slant {
            Slant::Ignored => 0.0,
            Slant::Whole => 1.0,
            Slant::Fading { widths } => {
                (to_edge(&self.proxy, place, wall) / (widths * lobe.alpha * distance)).clamp(0.0, 1.0)
            }
        };
        let normal = self.proxy.planes[wall].normal;
        let slant = slant_ratio(normal, lobe.axis, towards);
        let rho = distance / far * ops::pow(slant, 0.5 * share);
        // ratios of areas are clamped, as those of emitted lookups
        let [low, high] = Ratio::CERTIFIED;
        let rho = if self.slant == Slant::Ignored { rho } else { rho.clamp(low, high) };
        let alpha = self.width.of(lobe.alpha, rho);
        vec![Tap { towards, alpha, weight: 1.0 }]
    }
}
