//! `refracted-width`: which roughness of a prefiltered chain stands for the lobe that is refracted
//! through a rough interface, as glass seen from outside refracts it.
//!
//! Renderers fetch a prefiltered environment map, or a blurred picture of what lies behind, about the
//! refraction at the mean normal, the direction of `refract(-v, n, 1/ior)`. `radius` is the angle of
//! the cone about this direction that holds half of the energy that single scattering transmits, with
//! GGX, Smith's shadowing and the exact Fresnel term ([`lobe`]). `roughness_refracted` is the roughness r'
//! whose prefiltered lobe holds half of its energy within the same cone: the reflection lobe of alpha =
//! r'^2 with view, normal and mirror direction taken for one, weighted by the cosine
//! ([`Kernel::HalfCosine`]). It is 1 where no lobe of a chain is wide enough. Half of the energy is a
//! measure that the tails of GGX leave finite, where a variance is infinite.
//!
//! Left out are the second interface, through which the light leaves a solid; that the lobe is longer in
//! the plane of incidence than across, by 1/cos(theta_t); and that its middle leaves the refraction at
//! the mean normal where the view grazes a rough surface: the cone is then wider for it.
//!
//! Ends of the domain: alpha = 0 and ior = 1 refract into one direction, r' = 0. For alpha well below mu,
//! facets tilted by d across the plane of incidence deviate the light by k d, k = cos(theta_t) -
//! mu/ior, and in the plane by k d/cos(theta_t). With x and y the squares of both factors, the cone of radius
//! rho alpha holds rho^2/sqrt((rho^2 + x) (rho^2 + y)), half at rho^2 = (x + y + sqrt((x + y)^2 + 12 x
//! y))/6. A prefiltered lobe has half its energy within 2 alpha, so r' = r sqrt(rho/2): face on
//! r sqrt((ior - 1)/(2 ior)).

mod lobe;

use std::sync::LazyLock;

use rayon::prelude::*;

use super::{
    ALPHA, Asked, Choice, Facts, Input, MU, Quantity, Seen, Truth, Variant, check_domain, check_unit,
};
use crate::integrate::monte_carlo::{
    Draws, Run, Sampled, check_positive, check_samples, column, of_replicas, refract, shadowing,
};
use crate::integrate::{Goal, IntegrateError, PanelRule};
use crate::optics::kernel::Kernel;
use crate::optics::{Smith, ggx};
use lobe::Lobe;
use lobefit_math::{ops, sum};

/// Smallest alpha above 0.
const SMALLEST_ALPHA: f64 = 1e-4;

/// The quantity.
#[derive(Clone, Copy, Debug)]
pub struct RefractedWidth;

/// Bound of the error by default.
const TOLERANCE: f64 = 1e-8;

/// Rules of rising order: a value is that of the first that differs from the one before by no more than
/// the tolerance. A ring is narrow where the lobe is long: it has twice the nodes of a panel of rings.
static RULES: LazyLock<[Rule; 5]> = LazyLock::new(|| {
    [8, 16, 32, 64, 128].map(|n| Rule {
        finest: 1e-3,
        settled: 1e-14,
        rings: PanelRule::new(n),
        ring: PanelRule::new(2 * n),
    })
});

/// The rule for many points: within 2e-6 at 4000 points of mu from 0.01 and ior from 1.05.
static MANY: LazyLock<Rule> = LazyLock::new(|| Rule {
    finest: 0.01,
    settled: 1e-7,
    rings: PanelRule::new(8),
    ring: PanelRule::new(16),
});

/// Rings of lights.
#[derive(Clone, Debug)]
struct Rule {
    /// The smallest panel.
    finest: f64,
    /// The last step to the middle.
    settled: f64,
    rings: PanelRule,
    ring: PanelRule,
}

/// Error of many points, and the least mu and ior of their rule: also of 0.01 and 1.05 in f32.
const QUICK: f64 = 1e-5;
const QUICK_FROM: [f64; 2] = [0.01 * (1.0 - 1e-6), 1.05 * (1.0 - 1e-6)];

/// Rounding, relative: of sums, and of the steps that end in the middle.
const ROUNDING: f64 = 1e-13;

/// Steps of Newton's, or halvings of what holds a root: far more than are taken.
const STEPS: usize = 100;

/// The lobe of a chain that is widest, and half of whose energy lies within tan(theta/2) = WIDEST =
/// sqrt(2) - 1: u/(1 + u)^2 = 1/8 of u = tan^2(theta/2).
const WIDEST: f64 = std::f64::consts::SQRT_2 - 1.0;

/// tan(theta/2) of the cone of half of the energy by one rule; `None` if it is not found.
fn middle(lobe: &Lobe, rule: &Rule) -> Option<f64> {
    let cuts = lobe.cuts(rule.finest);
    let between = |from: f64, to: f64| {
        let mut sum = 0.0;
        rule.rings.each(from, to, |u, weight| sum += weight * lobe.ring(u, &rule.ring));
        sum
    };
    let panels: Vec<f64> = cuts.windows(2).map(|cut| between(cut[0], cut[1])).collect();
    let mut left = 0.5 * panels.iter().sum::<f64>();
    let panel = panels.iter().position(|panel| {
        let is_here = left <= *panel;
        left -= if is_here { 0.0 } else { *panel };
        is_here
    })?;
    let (from, mut low, mut high) = (cuts[panel], cuts[panel], cuts[panel + 1]);
    let mut u = low + (high - low) * left / panels[panel];
    for _ in 0..STEPS {
        let off = between(from, u) - left;
        if off > 0.0 {
            high = u
        } else {
            low = u
        }
        let next = u - off / lobe.ring(u, &rule.ring);
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        if (next - u).abs() <= rule.settled * (1.0 + u) {
            return Some(lobe.width() * ops::sinh(next));
        }
        u = next;
    }
    None
}

/// The alpha in (0, 1] of the prefiltered lobe with half of its energy within tan(theta/2) = t.
fn prefiltered(t: f64) -> f64 {
    // A cosine takes more of the lobe's rim than of its middle: alpha is not below t.
    let (mut low, mut high) = (t, 1.0);
    if t >= WIDEST {
        return high;
    }
    let tangent = 2.0 * t / ((1.0 - t) * (1.0 + t));
    for _ in 0..STEPS {
        let alpha = 0.5 * (low + high);
        if alpha <= low || alpha >= high {
            break;
        }
        if Kernel::HalfCosine.lobe(alpha).encircled(tangent) > 0.5 { low = alpha } else { high = alpha }
    }
    0.5 * (low + high)
}

/// The outputs by one rule.
fn by(lobe: &Lobe, rule: &Rule) -> Result<[f64; 2], IntegrateError> {
    let quantity = RefractedWidth.name();
    let lost = || IntegrateError::Search {
        quantity,
        start: vec![rule.finest],
        reason: format!("no cone holds half of the energy at {}", lobe.place()),
    };
    let t = middle(lobe, rule).ok_or_else(lost)?;
    let not_finite = || IntegrateError::NotFinite { quantity, place: lobe.place() };
    Some(t).filter(|t| t.is_finite()).map(outputs).ok_or_else(not_finite)
}

/// Roughness and radius of tan(theta/2).
fn outputs(t: f64) -> [f64; 2] {
    [prefiltered(t).sqrt(), 2.0 * ops::atan(t)]
}

fn check_inputs(x: &[f64]) -> Result<(), IntegrateError> {
    check_unit(&RefractedWidth, ALPHA.name, &x[..1], SMALLEST_ALPHA)?;
    check_domain(&RefractedWidth, &[x[0].min(1.0), x[1], x[2]])
}

/// Bins of ln(tan(theta/2)) from ln(NARROWEST) on, each a ten-thousandth or so of the angle wide:
/// within a bin the energy rises evenly to far below the error of any number of samples.
const BINS: usize = 1 << 17;
const NARROWEST: f64 = 1e-12;
const BIN: f64 = 2.5e-4;

/// tan(theta/2) of the cone of half of the energy, of one replica's samples.
fn sampled(smith: Smith, [alpha, mu, ior]: [f64; 3], samples: u64, mut draws: Draws) -> f64 {
    let view = [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu];
    let eta = 1.0 / ior;
    let axis = [-eta * view[0], 0.0, -(1.0 - eta * eta * view[0] * view[0]).sqrt()];
    let mut bins = vec![0.0; BINS];
    for _ in 0..samples {
        let x = draws.next();
        let (reflectance, light) = refract(eta, view, ggx::visible_normal([alpha; 2], view, x[0], x[1]));
        let Some(light) = light.filter(|light| light[2] < 0.0) else { continue };
        let length = |sign: f64| {
            (0..3).map(|i| (light[i] + sign * axis[i]) * (light[i] + sign * axis[i])).sum::<f64>()
        };
        let t = (length(-1.0) / length(1.0)).sqrt();
        let bin = (ops::log(t / NARROWEST) / BIN).clamp(0.0, (BINS - 1) as f64) as usize;
        bins[bin] += (1.0 - reflectance) * shadowing(smith, [alpha; 2], view, light).0;
    }
    let mut left = 0.5 * sum::pairwise(&bins);
    let mut at = 0.0;
    for energy in bins {
        if left <= energy {
            at += left / energy;
            break;
        }
        left -= energy;
        at += 1.0;
    }
    NARROWEST * ops::exp(BIN * at)
}

impl Quantity for RefractedWidth {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "refracted-width",
                inputs: &[ALPHA, MU, Input::new("ior", [1.0, 3.0]).usually([1.0, 2.0])],
                outputs: &["roughness_refracted", "radius", "error"],
                choices: &[Choice::Smith],
                tolerance: TOLERANCE,
                smallest_alpha: SMALLEST_ALPHA,
                remark: "from outside; of a chain of alpha = roughness^2; radius in radians",
                ..Facts::NONE
            }
        }
    }

    fn seen(&self) -> Option<&dyn Seen> {
        Some(self)
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        check_inputs(x)?;
        let [alpha, mu, ior] = [x[0], x[1], x[2]];
        if alpha == 0.0 || ior == 1.0 {
            return Ok(vec![0.0; 3]);
        }
        let lobe = Lobe::new(smith, alpha, mu, ior);
        // The difference itself, whatever less the error of the finer rule is.
        let bounded = |coarse: &[f64; 2], fine: &[f64; 2]| {
            let off = |k: usize| (fine[k] - coarse[k]).abs() + ROUNDING * fine[k];
            let error = off(0).max(off(1));
            Some((vec![fine[0], fine[1], error], error))
        };
        let goal = Goal { quantity: self.name(), place: &|| lobe.place(), tolerance };
        goal.climb(RULES.iter(), |rule| by(&lobe, rule), bounded)
    }

    fn many(&self, asked: &Asked) -> Result<Option<Truth>, IntegrateError> {
        if asked.tolerance < QUICK || asked.wants(&["error"]) {
            return Ok(None);
        }
        let (smith, places) = (asked.variant.smith(self.name())?, asked.places(self)?);
        let [alpha, mu, ior] = asked.columns(self)?;
        let one = |i: usize| {
            let x = [alpha[i], mu[i], ior[i]];
            if x[0] == 0.0 || x[1] < QUICK_FROM[0] || x[2] < QUICK_FROM[1] {
                return self.at(asked.variant, &x, QUICK);
            }
            check_inputs(&x)?;
            Ok(by(&Lobe::new(smith, x[0], x[1], x[2]), &MANY)?.to_vec())
        };
        let rows: Vec<Vec<f64>> = (0..alpha.len()).into_par_iter().map(one).collect::<Result<_, _>>()?;
        let columns = places.iter().map(|place| rows.iter().map(|row| row[*place]).collect()).collect();
        Ok(Some(Truth { columns, error: QUICK, evaluations: rows.len() as u64 }))
    }

    fn tolerance_of_many(&self, _: &Variant) -> f64 {
        QUICK
    }

    fn microseconds(&self, _: &[&str]) -> f64 {
        1e2
    }

    /// Visible normals, and vectors refracted at each; half of the energy by a histogram of the
    /// angle.
    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        check_inputs(x)?;
        check_samples(run)?;
        let [alpha, mu, ior] = [x[0], x[1], x[2]];
        check_positive(self.name(), &[("alpha", alpha), ("mu", mu), ("ior", ior - 1.0)])?;
        let found = of_replicas(run, |samples, draws| sampled(smith, [alpha, mu, ior], samples, draws));
        let means: Vec<[f64; 3]> = found.into_iter().map(outputs).map(|[a, b]| [a, b, 0.0]).collect();
        Ok((0..2).map(|k| column(&means, run.samples, |w| w[k])).collect())
    }
}
