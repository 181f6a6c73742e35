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
//! minimise, within 1 % over 140 walls, the squared H^-1 norms of the differences, each over the 3/4 power of that of one fetch, over walls at every slant to
//! shading point and probe ([`super::fit`]; the study fits on from them). Of 3000 other walls the two serve 5 worse than one fetch does, by more than 0.001 in
//! total variation, one of them by 0.12, the three 2, by less than 0.01. Two fail with azimuths near pi: at
//! alpha 0.08, cosines of 0.68 to both and a ratio of 0.71 they leave 0.17 where one leaves 0.12.

use super::expected::{self, EXPECTED};
use crate::optics::footprint::{RuleTap, Stretch};

/// a, c0, c1, c2, e0, e1, e2, n0, n1, f0, f1, w0, w1.
pub const TWO: [f64; 13] =
    [-0.336, 1.591, -0.566, 0.474, 0.014, -0.241, -0.491, -1.254, 1.368, 1.549, -1.749, -0.232, 0.612];

/// a, b0, b1, c0, c1, c2, d0, d1, e0, e1, e2, e3, n0, n1, f0, f1, g0, g1, g2, w0, w1, h0, h1.
pub const THREE: [f64; 23] = [
    -0.19, 2.538, -2.449, 2.697, -0.969, 0.743, -0.475, 0.415, 1.73, -0.961, -1.679, 1.282, -0.886, 0.909,
    -0.236, -0.085, 0.077, -0.632, -0.283, -0.804, 1.239, 0.961, 0.698,
];

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
    /// Those of [`TWO`] or [`THREE`], then nothing.
    constants: [f64; THREE.len()],
}

/// A lobe on a wall, as a rule sees it.
struct Skew {
    z: f64,
    y: f64,
    alpha: f64,
}

impl TapRule {
    /// One fetch along the lobe's axis.
    pub fn one() -> TapRule {
        TapRule { count: 1, constants: [0.0; THREE.len()] }
    }

    /// Two fetches.
    pub fn two() -> TapRule {
        TapRule { count: 2, constants: padded(&TWO) }
    }

    /// Three fetches.
    pub fn three() -> TapRule {
        TapRule { count: 3, constants: THREE }
    }

    /// The rule of as many fetches with other constants; `None` of another number of them.
    pub fn with(&self, constants: &[f64]) -> Option<TapRule> {
        let same = constants.len() == self.constants().len();
        same.then(|| TapRule { count: self.count, constants: padded(constants) })
    }

    /// How many fetches.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The constants, as [`TWO`] and [`THREE`] name them.
    pub fn constants(&self) -> &[f64] {
        let used = match self.count {
            2 => TWO.len(),
            3 => THREE.len(),
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

    /// What the fetches are expected to be off by in total variation: 0 where there is no stretch and no growth. See [`EXPECTED`].
    pub fn expected(&self, stretch: &Stretch, alpha: f64) -> f64 {
        expected::variation(&EXPECTED[self.count.clamp(1, 3) - 1], stretch, alpha)
    }
}

fn padded(constants: &[f64]) -> [f64; THREE.len()] {
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
