//! A lobe on a slanted wall, and fetches in its place.

use std::sync::OnceLock;

use super::QUANTITY;
use super::geometry::{OUTWARD, Slant};
use super::normal::Normal;
use super::wall::{Footprint, Resolution, Wall};
use crate::integrate::IntegrateError;
use crate::optics::footprint::{Hit, RuleTap, Stretch, width};
use crate::optics::kernel::Kernel;
use lobefit_math::vector::{Vec3, length, minus, normalise, plus, scaled};

/// Smallest width.
pub const SMALLEST_ALPHA: f64 = 1e-3;

/// Least cosine of a tilted ray to the wall's normal: 89 degrees.
const LEAST_STEEP: f64 = 0.0175;

/// Narrowest fetch over the width of the lobe.
const NARROWEST: f64 = 1e-2;

/// How far a fetch is from the footprint that it stands for.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Off {
    /// Total variation, in [0, 1].
    pub tv: f64,
    /// Root mean square difference of the energies per area, over the root mean square of the
    /// target's.
    pub l2: f64,
    /// Largest difference of the energies per area, over the target's largest.
    pub max: f64,
    /// The H^-1 norm times sqrt(2 pi), which is minimised.
    pub distance: f64,
}

/// The footprint of a lobe, and what fetches from the probe are off by.
#[derive(Clone, Debug)]
pub struct Case {
    /// Where shading point and probe stand.
    pub slant: Slant,
    /// The lobe's kernel.
    pub kernel: Kernel,
    /// Its width.
    pub alpha: f64,
    /// How the wall stretches it.
    pub stretch: Stretch,
    wall: Wall,
    target: Footprint,
    /// The target whitened, which searches alone look at.
    whitened: OnceLock<Vec<f64>>,
}

/// The normal equations of the squared distance over the logarithms of the widths and weights and
/// the tilts over alpha of fetches, in the order tilts, widths, weights.
pub type Squares = Normal;

impl Case {
    /// A lobe of a width in [1e-3, 1] about the ray of a slant.
    ///
    /// # Errors
    /// A width or slant outside of its domain.
    pub fn new(
        kernel: Kernel,
        alpha: f64,
        slant: Slant,
        resolution: Resolution,
    ) -> Result<Case, IntegrateError> {
        slant.check()?;
        let inside = (SMALLEST_ALPHA..=1.0).contains(&alpha);
        IntegrateError::outside(QUANTITY, [("alpha", alpha, inside, "is outside [1e-3, 1]")])?;
        let not_finite =
            || IntegrateError::NotFinite { quantity: QUANTITY, place: format!("alpha = {alpha}, {slant:?}") };
        let stretch = slant.stretch(alpha).ok_or_else(not_finite)?;
        let wall = Wall::new(&slant, alpha, resolution);
        let mut target = wall.footprint(&kernel.lobe(alpha), slant.place(), slant.ray());
        let whole = wall.whole(&target);
        if !(whole.is_finite() && whole > 0.0) {
            return Err(not_finite());
        }
        target.values.iter_mut().for_each(|value| *value /= whole);
        Ok(Case { slant, kernel, alpha, stretch, wall, target, whitened: OnceLock::new() })
    }

    /// The footprint of one fetch about the probe's ray to the place looked at, of a width in (0,
    /// 1].
    pub fn straight(&self, alpha: f64) -> Footprint {
        let probe = self.slant.probe_place();
        self.wall.footprint(&self.kernel.lobe(alpha), probe, normalise(scaled(probe, -1.0)))
    }

    fn whitened(&self) -> &[f64] {
        self.whitened.get_or_init(|| self.wall.whitened(&self.target))
    }

    /// Whether the ray of a fetch meets the wall.
    pub fn meets(&self, tap: &RuleTap) -> bool {
        self.fetch(tap).is_some()
    }

    /// The footprint of one fetch of a rule, its weight apart; `None` where its ray misses the
    /// wall.
    pub fn tapped(&self, tap: &RuleTap) -> Option<Footprint> {
        let (axis, alpha) = self.fetch(tap)?;
        Some(self.wall.footprint(&self.kernel.lobe(alpha), self.slant.probe_place(), axis))
    }

    /// The footprint of the fetches of a rule, normalised; those whose rays miss the wall are
    /// dropped. `None` where all do.
    pub fn fetched(&self, taps: &[RuleTap]) -> Option<Footprint> {
        let mut sum = Footprint { values: vec![0.0; self.target.values.len()] };
        for tap in taps {
            if let Some(one) = self.tapped(tap) {
                sum.values.iter_mut().zip(&one.values).for_each(|(s, v)| *s += tap.weight * v);
            }
        }
        self.normalised(sum)
    }

    /// A footprint over its integral; `None` of nothing.
    pub fn normalised(&self, mut footprint: Footprint) -> Option<Footprint> {
        let whole = self.wall.whole(&footprint);
        footprint.values.iter_mut().for_each(|value| *value /= whole);
        (whole > 0.0 && whole.is_finite()).then_some(footprint)
    }

    /// Total variation between a normalised footprint and the lobe's: [`Off::tv`] alone, at half the
    /// work.
    pub fn variation(&self, footprint: &Footprint) -> f64 {
        0.5 * self.wall.variation(&self.target, footprint)
    }

    /// How far a normalised footprint is from the lobe's.
    pub fn off(&self, footprint: &Footprint) -> Off {
        let [rms, max, whole, peak] = self.wall.per_area(&self.target, footprint);
        let square: f64 = self.residuals(footprint).iter().map(|r| r * r).sum();
        Off { tv: self.variation(footprint), l2: rms / whole, max: max / peak, distance: square.sqrt() }
    }

    /// The normal equations at tilts over alpha, logarithms of widths and logarithms of weights;
    /// `None` where a ray misses the wall or a number is none.
    pub fn squares(&self, taps: &[[f64; 3]]) -> Option<Squares> {
        let whole: f64 = taps.iter().map(|[_, _, weight]| lobefit_math::ops::exp(*weight)).sum();
        let rule: Vec<RuleTap> = taps.iter().map(|tap| self.rule_tap(*tap, whole)).collect();
        let ones = taps.iter().map(|tap| self.one(*tap)).collect::<Option<Vec<One>>>()?;
        // sum w F/sum w e: a mixture whose shares v = w e/sum w e
        let energy: f64 = ones.iter().zip(&rule).map(|(one, tap)| tap.weight * one.energy).sum();
        let scale = 1.0 / energy;
        let sum = |of: &dyn Fn(&One) -> &[f64]| {
            let mut sum = vec![0.0; self.whitened().len()];
            for (one, tap) in ones.iter().zip(&rule) {
                sum.iter_mut().zip(of(one)).for_each(|(s, v)| *s += tap.weight * scale * v);
            }
            sum
        };
        let fetched = sum(&|one| &one.white);
        let residuals: Vec<f64> = fetched.iter().zip(self.whitened()).map(|(f, t)| f - t).collect();
        let column = |white: &[f64], energy: f64, weight: f64| -> Vec<f64> {
            let off = white.iter().zip(&fetched).map(|(w, f)| weight * scale * (w - energy * f));
            off.collect()
        };
        let each = || ones.iter().zip(&rule);
        let mut columns: Vec<Vec<f64>> =
            each().map(|(one, tap)| column(&one.tilted.0, one.tilted.1, tap.weight)).collect();
        columns.extend(each().map(|(one, tap)| column(&one.widened.0, one.widened.1, tap.weight)));
        columns.extend(each().map(|(one, tap)| column(&one.white, one.energy, tap.weight)));
        Normal::of(&residuals, &columns)
    }

    /// A fetch from its tilt over alpha and the logarithms of its width and weight, whose weights
    /// sum to `whole`.
    pub fn rule_tap(&self, [tilt, width, weight]: [f64; 3], whole: f64) -> RuleTap {
        use lobefit_math::ops::exp;
        RuleTap { tilt: tilt * self.alpha, width: exp(width), weight: exp(weight) / whole }
    }

    /// A fetch from its tilt over alpha and the logarithms of its width and weight.
    pub fn tap(&self, at: [f64; 3]) -> RuleTap {
        self.rule_tap(at, 1.0)
    }

    fn residuals(&self, footprint: &Footprint) -> Vec<f64> {
        let white = self.wall.whitened(footprint);
        white.iter().zip(self.whitened()).map(|(f, t)| f - t).collect()
    }

    /// Axis and width of a fetch from the probe.
    fn fetch(&self, tap: &RuleTap) -> Option<(Vec3, f64)> {
        let (place, probe) = (self.slant.place(), self.slant.probe_place());
        let ray = normalise(plus(self.slant.ray(), scaled(self.stretch.major, tap.tilt)));
        let steep = -ray[2];
        if steep.is_nan() || steep <= LEAST_STEEP {
            return None;
        }
        let hit = Hit { place: plus(place, scaled(ray, place[2] / steep)), normal: OUTWARD };
        let area = Stretch::of(place, hit, probe)?.area;
        let seen = minus(hit.place, probe);
        let narrowest = NARROWEST * self.alpha;
        Some((scaled(seen, 1.0 / length(seen)), width(tap.width * self.alpha, area).max(narrowest)))
    }

    /// A fetch with its derivatives by tilt over alpha and logarithm of width, one-sided.
    fn one(&self, at: [f64; 3]) -> Option<One> {
        let of = |tilt: f64, width: f64| -> Option<(Vec<f64>, f64)> {
            let footprint = self.tapped(&self.rule_tap([at[0] + tilt, at[1] + width, 0.0], 1.0))?;
            Some((self.wall.whitened(&footprint), self.wall.whole(&footprint)))
        };
        let (white, energy) = of(0.0, 0.0)?;
        let by = |(other, whole): (Vec<f64>, f64), step: f64| {
            let slopes = other.iter().zip(&white).map(|(a, b)| (a - b) / step).collect();
            (slopes, (whole - energy) / step)
        };
        // towards the ray where the wall ends
        let tilted = match of(DIFFERENCE, 0.0) {
            Some(other) => by(other, DIFFERENCE),
            None => by(of(-DIFFERENCE, 0.0)?, -DIFFERENCE),
        };
        let widened = by(of(0.0, DIFFERENCE)?, DIFFERENCE);
        Some(One { white, energy, tilted, widened })
    }
}

/// Step of a difference: its error and that of rounding are both 1e-5 of the slope or less.
const DIFFERENCE: f64 = 1e-5;

/// A fetch, whitened, with its energy on the wall and the derivatives of both.
struct One {
    white: Vec<f64>,
    energy: f64,
    tilted: (Vec<f64>, f64),
    widened: (Vec<f64>, f64),
}
