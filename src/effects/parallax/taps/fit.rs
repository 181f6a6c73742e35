//! The constants of a rule, fitted over walls at every slant.

use std::f64::consts::PI;
use std::sync::OnceLock;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::least::least;
use super::rule::TapRule;
use lobefit_math::ops;
use lobefit_math::sobol::Sobol;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::optics::footprint::RuleTap;
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::footprint::slant::{Case, Normal, Resolution, Slant, Stand};

/// A lobe on a wall with how hard it is for one fetch.
#[derive(Clone, Debug)]
pub struct Situation {
    /// The lobe and the wall.
    pub case: Case,
    /// What one fetch of the lobe is off by.
    pub one: f64,
    /// Its H^-1 norm, which fits alone look at.
    distance: OnceLock<Option<f64>>,
}

/// Slants of the walls that the probe stands in front of, in degrees.
const IN_FRONT: [f64; 6] = [8.0, 20.0, 40.0, 55.0, 65.0, 75.0];

/// Cosines of the other slants, and ratios of distances.
const COSINES: [f64; 2] = [0.15, 1.0];
const RATIOS: [f64; 2] = [0.15, 2.0];

/// Walls at slants to shading point and probe, evenly over the cosines of both slants above 0.15,
/// the azimuth and the logarithm of the ratio of the distances in [0.15, 2]: a Sobol set of a seed
/// for the first three, one in an order of its own for the ratio.
pub fn slants(count: u32, seed: u32) -> Vec<Slant> {
    let first = Sobol::new([seed, seed ^ 0x51ed_270b, seed ^ 0x2545_f491]);
    let second = Sobol::new([seed ^ 0x0123_4567, 0, 0]).padded(seed.wrapping_mul(0x9e37_79b9) ^ 0x68e3_1da4);
    let mix = |[low, high]: [f64; 2], t: f64| low + (high - low) * t;
    let slant = |t: f64| ops::acos(mix(COSINES, t));
    let distance = |t: f64| ops::exp(mix(RATIOS.map(ops::log), t));
    let wall = |i: u32| Slant {
        shading: Stand { distance: distance(second.coordinate(i, 0)), slant: slant(first.coordinate(i, 0)) },
        probe: Stand { distance: 1.0, slant: slant(first.coordinate(i, 1)) },
        azimuth: PI * first.coordinate(i, 2),
    };
    (0..count).map(wall).collect()
}

/// A kernel's lobes of some widths on walls: for each width those in front of the probe, and
/// `count` in all of the walls of [`slants`].
///
/// # Errors
/// As [`Case::new`].
pub fn situations(
    kernel: &Kernel,
    alphas: &[f64],
    count: u32,
    seed: u32,
    resolution: Resolution,
) -> Result<Vec<Situation>, IntegrateError> {
    let tilted = slants(count, seed);
    let mut all: Vec<(f64, Slant)> = Vec::new();
    for alpha in alphas {
        all.extend(IN_FRONT.map(|psi| (*alpha, Slant::in_front(psi * PI / 180.0))));
    }
    // a run of the set for each width: every other point of it lies in one half of the first cosine
    let width = |i: u32| alphas[i as usize * alphas.len() / count as usize];
    all.extend((0..count).map(width).zip(tilted));
    all.into_par_iter().map(|(alpha, slant)| Situation::new(kernel, alpha, slant, resolution)).collect()
}

impl Situation {
    /// A lobe on a wall.
    ///
    /// # Errors
    /// As [`Case::new`].
    pub fn new(
        kernel: &Kernel,
        alpha: f64,
        slant: Slant,
        resolution: Resolution,
    ) -> Result<Situation, IntegrateError> {
        let case = Case::new(kernel.clone(), alpha, slant, resolution)?;
        let one = TapRule::one().taps(&case.stretch, alpha);
        let one = case.fetched(&one).map(|footprint| case.variation(&footprint));
        let one = one.ok_or_else(|| IntegrateError::NotFinite {
            quantity: "one fetch",
            place: format!("alpha = {alpha}, {slant:?}"),
        })?;
        Ok(Situation { case, one, distance: OnceLock::new() })
    }

    fn distance(&self) -> Option<f64> {
        *self.distance.get_or_init(|| {
            let one = TapRule::one().taps(&self.case.stretch, self.case.alpha);
            self.case.fetched(&one).map(|fetched| self.case.off(&fetched).distance)
        })
    }

    /// Total variation of a rule's fetches; that of one where no ray of theirs meets the wall.
    pub fn variation(&self, rule: &TapRule) -> f64 {
        let taps = rule.taps(&self.case.stretch, self.case.alpha);
        self.case.fetched(&taps).map_or(self.one, |footprint| self.case.variation(&footprint))
    }

    /// The normal equations of the weighted square of the distance over a rule's constants.
    fn squares(&self, rule: &TapRule) -> Option<(f64, Normal, DMatrix<f64>)> {
        let alpha = self.case.alpha;
        let at = |rule: &TapRule| -> Vec<[f64; 3]> {
            rule.taps(&self.case.stretch, alpha).iter().map(|tap| coordinates(tap, alpha)).collect()
        };
        let here = at(rule);
        // rays that miss the wall are dropped
        let kept: Vec<usize> =
            (0..here.len()).filter(|i| self.case.meets(&self.case.tap(here[*i]))).collect();
        let normal = self.case.squares(&kept.iter().map(|i| here[*i]).collect::<Vec<_>>())?;
        let mut by = DMatrix::zeros(3 * kept.len(), rule.constants().len());
        for j in 0..rule.constants().len() {
            let mut constants = rule.constants().to_vec();
            constants[j] += STEP;
            let moved = at(&rule.with(&constants)?);
            for (row, i) in kept.iter().enumerate() {
                for part in 0..3 {
                    by[(part * kept.len() + row, j)] = (moved[*i][part] - here[*i][part]) / STEP;
                }
            }
        }
        let distance = self.distance()?;
        // the 3/4 power of the square
        Some((1.0 / (distance * distance.sqrt()).max(LEAST), normal, by))
    }
}

/// Step of a difference of constants.
const STEP: f64 = 1e-6;

/// Least denominator of a weight: walls that one fetch serves well count no more than these.
const LEAST: f64 = 1e-5;

/// Least weight in a logarithm.
const LIGHTEST: f64 = 1e-5;

fn coordinates(tap: &RuleTap, alpha: f64) -> [f64; 3] {
    [tap.tilt / alpha, ops::log(tap.width), ops::log(tap.weight.max(LIGHTEST))]
}

/// A fitted rule.
#[derive(Clone, Debug, PartialEq)]
pub struct RuleFit {
    /// With its constants.
    pub rule: TapRule,
    /// The weighted sum of squares, of the start and in the end.
    pub sums: [f64; 2],
    /// Whether the search came to rest.
    pub settled: bool,
}

/// The constants of a rule that serve the situations best, from its own. The same for any number of
/// threads.
///
/// # Errors
/// Constants that give fetches of no width; a solver that fails.
pub fn fit(rule: &TapRule, situations: &[Situation], iterations: u64) -> Result<RuleFit, IntegrateError> {
    let count = rule.constants().len();
    let squares = |constants: &[f64]| -> Option<Normal> {
        let rule = rule.with(constants)?;
        let parts: Vec<_> = situations.par_iter().map(|situation| situation.squares(&rule)).collect();
        let mut sum =
            Normal { value: 0.0, gradient: DVector::zeros(count), hessian: DMatrix::zeros(count, count) };
        for part in parts {
            let (weight, normal, by) = part?;
            sum.add(weight, &normal, &by);
        }
        sum.finite()
    };
    let found = least(squares, rule.constants(), iterations)?;
    let fitted = rule.with(&found.at).ok_or_else(|| IntegrateError::NotFinite {
        quantity: "fetches",
        place: format!("constants {:?}", found.at),
    })?;
    Ok(RuleFit { rule: fitted, sums: [found.start, found.value], settled: found.settled })
}
