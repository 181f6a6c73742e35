//! Lookups with and without parallax.

use super::shading::{Shading, ShadingLobe};
use crate::effects::parallax::room::{Lookup, Meeting, Proxy, Seen, Tap};
use crate::effects::parallax::taps::horizon::fade;
use crate::effects::parallax::{RuleTap, Stretch, TapRule, width};
use lobefit_math::vector::{Vec3, dot, length, minus, normalise, plus, scaled};

/// How much wider a lobe looks from the probe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ratio {
    /// By the distances of shading point and probe.
    Distance,
    /// By the root of the ratio of solid angles, within [`Ratio::CERTIFIED`].
    Area,
}

impl Ratio {
    /// The ratios that widths are certified over in the built-in scene, to which emitted lookups
    /// clamp theirs.
    pub const CERTIFIED: [f64; 2] = [1.0 / 16.0, 8.0];
}

/// Which width is fetched for a lobe of width alpha in (0, 1] that looks rho >= 0 times as wide.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Width {
    /// alpha.
    Same,
    /// Listing 25 of Lagarde and de Rousiers 2014: r = sqrt(alpha) goes to mix(clamp(rho r, 0, r),
    /// r, r).
    Frostbite,
    /// min(1, rho alpha).
    Scaled,
    /// rho alpha/max(1 + alpha - rho alpha, rho alpha).
    Rational,
    /// The same with x = rho alpha and (alpha - x) (k + c (alpha + x) + d alpha x) for alpha - x.
    Cubic {
        /// Of the difference.
        k: f64,
        /// Of that times the sum.
        c: f64,
        /// Of that times the product.
        d: f64,
    },
}

impl Width {
    /// What lookups are emitted with where no scene says otherwise: the fit `parallax_1` of the
    /// built-in scene's probe.
    pub const EMITTED: Width = Width::Cubic { k: 1.048_127, c: 0.0, d: 0.0 };

    /// The width, in (0, 1].
    pub fn of(self, alpha: f64, rho: f64) -> f64 {
        match self {
            Width::Same => alpha,
            Width::Frostbite => {
                let r = alpha.sqrt();
                let scaled = r + (1.0 - r) * ((rho * r).clamp(0.0, r) - r);
                scaled * scaled
            }
            Width::Scaled => (rho * alpha).min(1.0),
            Width::Rational => width(alpha, rho),
            Width::Cubic { k, c, d } => {
                let x = rho * alpha;
                x / (1.0 + (alpha - x) * (k + c * (alpha + x) + d * alpha * x)).max(x)
            }
        }
    }
}

/// Fetches along the lobe's own axis, as if the probe were at the shading point.
#[derive(Clone, Copy, Debug)]
pub struct Uncorrected {
    /// What the lobe is taken for.
    pub shading: Shading,
}

impl Lookup for Uncorrected {
    fn taps(&self, seen: &Seen) -> Vec<Tap> {
        let lobe = self.shading.lobe(seen);
        vec![Tap { towards: lobe.axis, alpha: lobe.alpha, weight: 1.0 }]
    }
}

/// Fetches where the rays of a lobe meet a proxy.
#[derive(Clone, Debug)]
pub struct Corrected<P> {
    /// What the room is taken for.
    pub proxy: P,
    /// Where the cubemap was taken.
    pub probe: Vec3,
    /// What the lobe is taken for.
    pub shading: Shading,
    /// The fetches.
    pub rule: TapRule,
    /// How much wider the lobe looks from the probe.
    pub ratio: Ratio,
    /// Which width is fetched for that.
    pub width: Width,
}

impl<P: Proxy> Lookup for Corrected<P> {
    /// Rays that leave below the surface fade out ([`fade`]); those that miss the proxy are dropped
    /// and the rest weighted up; where the lobe's axis misses it, the one fetch is along the axis.
    fn taps(&self, seen: &Seen) -> Vec<Tap> {
        let lobe = self.shading.lobe(seen);
        let met = self.meet(seen, lobe.axis, lobe.alpha);
        let stretch = |met: &Meeting| Stretch::of_lobe(seen.place, met, self.probe, lobe.alpha, lobe.axes);
        let Some((met, stretch)) = met.and_then(|met| Some((met, stretch(&met)?))) else {
            return vec![Tap { towards: lobe.axis, alpha: lobe.alpha, weight: 1.0 }];
        };
        let mut rule = self.rule.taps(&stretch, lobe.alpha);
        fade(&mut rule, lobe.axis, stretch.major, seen.normal);
        let rays = rule.iter().filter_map(|tap| self.fetch(seen, &lobe, &stretch, tap));
        let mut taps: Vec<Tap> = rays.collect();
        if taps.is_empty() {
            taps.extend(self.tap(seen, &met, lobe.alpha, 1.0));
        }
        let whole: f64 = taps.iter().map(|tap| tap.weight).sum();
        taps.iter_mut().for_each(|tap| tap.weight /= whole);
        taps
    }
}

impl<P: Proxy> Corrected<P> {
    /// What a ray meets in front of the shading point.
    fn meet(&self, seen: &Seen, ray: Vec3, alpha: f64) -> Option<Meeting> {
        self.proxy.meet(seen.place, ray, alpha).filter(|met| met.distance > 0.0)
    }

    fn fetch(&self, seen: &Seen, lobe: &ShadingLobe, stretch: &Stretch, tap: &RuleTap) -> Option<Tap> {
        let ray = normalise(plus(lobe.axis, scaled(stretch.major, tap.tilt)));
        let met = self.meet(seen, ray, lobe.alpha)?;
        self.tap(seen, &met, tap.width * lobe.alpha, tap.weight)
    }

    fn tap(&self, seen: &Seen, met: &Meeting, alpha: f64, weight: f64) -> Option<Tap> {
        let from = minus(met.place, self.probe);
        let away = length(from);
        let rho = match self.ratio {
            Ratio::Distance => met.distance / away,
            Ratio::Area => {
                let [low, high] = Ratio::CERTIFIED;
                let cosines = dot(met.normal, from).max(0.0) / dot(met.normal, minus(met.place, seen.place));
                let ratio = met.distance / away;
                (ratio * (ratio * cosines).sqrt()).clamp(low, high)
            }
        };
        let alpha = self.width.of(alpha, rho);
        (alpha > 0.0).then(|| Tap { towards: normalise(from), alpha, weight })
    }
}
