//! Where the fetches go, how wide they are and what they weigh.
//!
//! With z = [`Stretch::length`], sigma = alpha [`Stretch::growth`] the change of ln(d_s/d_p) over the width of the lobe, y = (1 + a alpha)
//! sigma/(z + alpha), and tilts in units of alpha before the last step, the two fetches are at
//!
//!   -+z (c0 + c1 z)/(1 + c2 alpha), of widths 1 + z (e0 + e1 z + e2 alpha) + y (n0 + n1 z) near and y (f0 + f1 z) far,
//!   of weights (1 +- k/sqrt(z^2 + k^2))/2, k = y (w0 + w1 z).
//!
//! The three, with Y = y (b0 + b1 z)/z in [0, 1.5] and A = (c0 + c1 z)/(1 + c2 alpha), are at -A (sqrt(1 + Y^2) - Y), y (d0 + d1 z) and
//! A (sqrt(1 + Y^2) + Y), the outer ones of widths e0 + e1 z + alpha (e2 + e3 z) with y (n0 + n1 z) and y (f0 + f1 z) as above, the
//! inner one 1 + z (g0 + g1 z + g2 alpha), of weights G (sqrt(1 + W^2) +- W) and 1, W = y (w0 + w1 z)/z in [-1.5, 1.5], G = z^2 (h0 z + h1 alpha),
//! over their sum. Where the footprint is round and grows nowhere, z = y = 0, all of it is the one fetch of the lobe; where it does not grow,
//! near and far mirror each other, so that nothing jumps where the growth changes its sign.
//! Where it grows, several fetches are left at kappa = 1, and z = 0 with growth is a place where they may jump: the growth's own part of the length,
//! alpha^2 g g^T, then just makes up for kappa, the long axis turns by 90 degrees there, and with it what it grows by along itself.
//!
//! Last, a tilt of tangent t = c alpha becomes t/(1 + max(t s, 0)), s = [`Stretch::slope`]: no ray is tilted past the plane of the wall. The constants
//! are fitted lobe by lobe ([`Constants`]). What two fail with on walls of half-cosine lobes is mostly at azimuths near pi.

use super::constants::{Constants, HALF_COSINE, Three, Two};
use super::expected::{self, Expected};
use lobefit_truth::optics::footprint::{RuleTap, Stretch};
use lobefit_truth::optics::kernel::Kernel;

/// Largest skewness of the three.
const MOST_SKEWED: f64 = 1.5;

/// Least width over that of the lobe.
const NARROWEST: f64 = 0.1;

/// Below, z counts as this in a denominator; what it divides has z as a factor.
const LEAST_LENGTH: f64 = 1e-6;

/// A rule for a number of fetches: one fetch of the lobe itself where the footprint is round and grows nowhere, and continuous in the stretch
/// but where it is round (z = 0) and grows.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct TapRule {
    count: usize,
    /// Those of [`Two`] or [`Three`], then nothing.
    constants: [f64; MOST],
    expected: Expected,
}

/// Most constants of a rule.
const MOST: usize = size_of::<Three>() / size_of::<f64>();

/// A lobe on a wall, as a rule sees it.
struct Skew {
    z: f64,
    y: f64,
    alpha: f64,
}

impl TapRule {
    /// The rule of 1, 2 or 3 fetches for chains of a kernel; `None` of another number, and of several where no rule is fitted for the kernel. One
    /// fetch from a chain of such a kernel is taken to be as far off as one from half-cosine chains.
    pub fn of(kernel: Kernel, fetches: usize) -> Option<TapRule> {
        let constants = Constants::of(kernel);
        match fetches {
            1 => Some(TapRule::new(&[], 1, constants.unwrap_or(&HALF_COSINE))),
            2 => constants.map(|constants| TapRule::new(&constants.two, 2, constants)),
            3 => constants.map(|constants| TapRule::new(&constants.three, 3, constants)),
            _ => None,
        }
    }

    fn new(constants: &[f64], count: usize, of: &Constants) -> TapRule {
        TapRule { count, constants: padded(constants), expected: of.expected[count - 1] }
    }

    /// One fetch along the lobe's axis.
    pub fn one() -> TapRule {
        TapRule::new(&[], 1, &HALF_COSINE)
    }

    /// Two fetches from a half-cosine chain.
    pub fn two() -> TapRule {
        TapRule::new(&HALF_COSINE.two, 2, &HALF_COSINE)
    }

    /// Three fetches from a half-cosine chain.
    pub fn three() -> TapRule {
        TapRule::new(&HALF_COSINE.three, 3, &HALF_COSINE)
    }

    /// The rule of as many fetches with other constants; `None` of another number of them.
    pub fn with(&self, constants: &[f64]) -> Option<TapRule> {
        let same = constants.len() == self.constants().len();
        same.then(|| TapRule { constants: padded(constants), ..*self })
    }

    /// How many fetches.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The constants, in the order of [`Two`] and [`Three`].
    pub fn constants(&self) -> &[f64] {
        let used = match self.count {
            2 => size_of::<Two>() / size_of::<f64>(),
            3 => MOST,
            _ => 0,
        };
        &self.constants[..used]
    }

    /// The fetches for a lobe of width `alpha` in [0, 1], from the one nearest to the shading point to the farthest.
    pub fn taps(&self, stretch: &Stretch, alpha: f64) -> Vec<RuleTap> {
        let skew = |a: f64| {
            let z = stretch.length;
            let y = (1.0 + a * alpha) * alpha * stretch.growth / (z + alpha).max(f64::MIN_POSITIVE);
            Skew { z, y, alpha }
        };
        let mut taps = match (self.count, self.constants()) {
            (2, &[a, ref rest @ ..]) => two(&skew(a), rest),
            (3, &[a, ref rest @ ..]) => three(&skew(a), rest),
            _ => vec![RuleTap { tilt: 0.0, width: 1.0, weight: 1.0 }],
        };
        for tap in &mut taps {
            let tilt = tap.tilt * alpha;
            tap.tilt = tilt / (1.0 + (tilt * stretch.slope).max(0.0));
            tap.width = tap.width.max(NARROWEST);
        }
        taps
    }

    /// What the fetches are expected to be off by in total variation: 0 where there is no stretch and no growth.
    pub fn expected(&self, stretch: &Stretch, alpha: f64) -> f64 {
        expected::variation(&self.expected.constants, stretch, alpha)
    }

    /// The formula of that, and how far off it is.
    pub fn expectation(&self) -> &Expected {
        &self.expected
    }
}

fn padded(constants: &[f64]) -> [f64; MOST] {
    std::array::from_fn(|i| constants.get(i).copied().unwrap_or(0.0))
}

fn two(skew: &Skew, constants: &[f64]) -> Vec<RuleTap> {
    let &[c0, c1, c2, e0, e1, e2, n0, n1, f0, f1, w0, w1] = constants else { return Vec::new() };
    let &Skew { z, y, alpha } = skew;
    let tilt = z * (c0 + c1 * z) / (1.0 + c2 * alpha);
    let width = 1.0 + z * (e0 + e1 * z + e2 * alpha);
    let k = y * (w0 + w1 * z);
    let lean = 0.5 * k / (z * z + k * k).max(f64::MIN_POSITIVE).sqrt();
    vec![
        RuleTap { tilt: -tilt, width: width + y * (n0 + n1 * z), weight: 0.5 + lean },
        RuleTap { tilt, width: width + y * (f0 + f1 * z), weight: 0.5 - lean },
    ]
}

fn three(skew: &Skew, constants: &[f64]) -> Vec<RuleTap> {
    let &[b0, b1, c0, c1, c2, d0, d1, e0, e1, e2, e3, n0, n1, f0, f1, g0, g1, g2, w0, w1, h0, h1] = constants
    else {
        return Vec::new();
    };
    let &Skew { z, y, alpha } = skew;
    let over = y / z.max(LEAST_LENGTH);
    let skewed = (over * (b0 + b1 * z)).clamp(0.0, MOST_SKEWED);
    let root = (1.0 + skewed * skewed).sqrt();
    let tilt = (c0 + c1 * z) / (1.0 + c2 * alpha);
    let width = e0 + e1 * z + alpha * (e2 + e3 * z);
    let leaning = (over * (w0 + w1 * z)).clamp(-MOST_SKEWED, MOST_SKEWED);
    let lean = (1.0 + leaning * leaning).sqrt();
    let outer = z * z * (h0 * z + h1 * alpha);
    let share = 1.0 / (1.0 + 2.0 * outer * lean);
    vec![
        RuleTap {
            tilt: -tilt * (root - skewed),
            width: width + y * (n0 + n1 * z),
            weight: outer * (lean + leaning) * share,
        },
        RuleTap { tilt: y * (d0 + d1 * z), width: 1.0 + z * (g0 + g1 * z + g2 * alpha), weight: share },
        RuleTap {
            tilt: tilt * (root + skewed),
            width: width + y * (f0 + f1 * z),
            weight: outer * (lean - leaning) * share,
        },
    ]
}
