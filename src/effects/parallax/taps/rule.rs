//! Where the fetches go, how wide they are and what they weigh.
//!
//! With z = [`Stretch::length`], sigma = alpha [`Stretch::growth`] the change of ln(d_s/d_p) over
//! the width of the lobe, y = (1 + a alpha) sigma/(z + alpha), and tilts in units of alpha before
//! the last step, the two fetches are at
//!
//!   -+z (c0 + c1 z)/(1 + c2 alpha), of widths 1 + z (e0 + e1 z + e2 alpha) +
//!   y (n0 + n1 z) near and y (f0 + f1 z) far,
//!   of weights (1 +- k/sqrt(z^2 + k^2))/2, k = y (w0 + w1 z).
//!
//! The three, with Y = y (b0 + b1 z)/z in [0, 1.5] and A = (c0 + c1 z)/(1 + c2 alpha), are at -A
//! (sqrt(1 + Y^2) - Y), y (d0 + d1 z) and A (sqrt(1 + Y^2) + Y), the outer ones of widths e0 + e1
//! z + alpha (e2 + e3 z) with y (n0 + n1 z) and y (f0 + f1 z) as above, the inner one 1 + z
//! (g0 + g1 z + g2 alpha), of weights G (sqrt(1 + W^2) +- W) and 1, W = y (w0 + w1 z)/z in [-1.5,
//! 1.5], G = z^2 (h0 z + h1 alpha), over their sum. Where the footprint is round and grows nowhere,
//! z = y = 0, all of it is the one fetch of the lobe; where it does not grow, near and far mirror
//! each other, so that nothing jumps where the growth changes its sign. Where it grows, several
//! fetches are left at kappa = 1, and z = 0 with growth is a place where they may jump: the
//! growth's own part of the length, alpha^2 g g^T, then just makes up for kappa, the long axis
//! turns by 90 degrees there, and with it what it grows by along itself.
//!
//! Last, a tilt of tangent t = c alpha becomes t/(1 + max(t s, 0)), s = [`Stretch::slope`]: no ray
//! is tilted past the plane of the wall. The constants are fitted lobe by lobe ([`Constants`]).
//! What two fail with on walls of half-cosine lobes is mostly at azimuths near pi.

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

/// A rule for a number of fetches: one fetch of the lobe itself where the footprint is round and
/// grows nowhere, and continuous in the stretch but where it is round (z = 0) and grows.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(into = "Row")]
pub struct TapRule {
    form: Form,
    expected: Expected,
}

/// The formula of a number of fetches, with its constants.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    One,
    Two(Two),
    Three(Three),
}

/// A rule in JSON: rows of one length, the constants followed by zeros.
#[derive(serde::Serialize)]
struct Row {
    count: usize,
    constants: Vec<f64>,
    expected: Expected,
}

impl From<TapRule> for Row {
    fn from(rule: TapRule) -> Row {
        let mut constants = rule.constants().to_vec();
        constants.resize(size_of::<Three>() / size_of::<f64>(), 0.0);
        Row { count: rule.count(), constants, expected: rule.expected }
    }
}

/// A lobe on a wall, as a rule sees it.
struct Skew {
    z: f64,
    y: f64,
    alpha: f64,
}

impl TapRule {
    /// The rule of 1, 2 or 3 fetches for chains of a kernel; `None` of another number, and of
    /// several where no rule is fitted for the kernel. One fetch from a chain of such a kernel is
    /// taken to be as far off as one from half-cosine chains.
    pub fn of(kernel: &Kernel, fetches: usize) -> Option<TapRule> {
        let constants = Constants::of(kernel);
        let rule = |form, of: &Constants| TapRule { form, expected: of.expected[fetches - 1] };
        match fetches {
            1 => Some(rule(Form::One, constants.unwrap_or(&HALF_COSINE))),
            2 => constants.map(|constants| rule(Form::Two(constants.two), constants)),
            3 => constants.map(|constants| rule(Form::Three(constants.three), constants)),
            _ => None,
        }
    }

    /// One fetch along the lobe's axis.
    pub fn one() -> TapRule {
        TapRule { form: Form::One, expected: HALF_COSINE.expected[0] }
    }

    /// Two fetches from a half-cosine chain.
    pub fn two() -> TapRule {
        TapRule { form: Form::Two(HALF_COSINE.two), expected: HALF_COSINE.expected[1] }
    }

    /// Three fetches from a half-cosine chain.
    pub fn three() -> TapRule {
        TapRule { form: Form::Three(HALF_COSINE.three), expected: HALF_COSINE.expected[2] }
    }

    /// The rule of as many fetches with other constants; `None` of another number of them.
    pub fn with(&self, constants: &[f64]) -> Option<TapRule> {
        let form = match self.form {
            Form::One => constants.is_empty().then_some(Form::One)?,
            Form::Two(_) => Form::Two(constants.try_into().ok()?),
            Form::Three(_) => Form::Three(constants.try_into().ok()?),
        };
        Some(TapRule { form, ..*self })
    }

    /// How many fetches.
    pub fn count(&self) -> usize {
        match self.form {
            Form::One => 1,
            Form::Two(_) => 2,
            Form::Three(_) => 3,
        }
    }

    /// The constants, in the order of [`Two`] and [`Three`].
    pub fn constants(&self) -> &[f64] {
        match &self.form {
            Form::One => &[],
            Form::Two(constants) => constants,
            Form::Three(constants) => constants,
        }
    }

    /// The fetches for a lobe of width `alpha` in [0, 1], from the one nearest to the shading point
    /// to the farthest.
    pub fn taps(&self, stretch: &Stretch, alpha: f64) -> Vec<RuleTap> {
        let skew = |a: f64| {
            let z = stretch.length;
            let y = (1.0 + a * alpha) * alpha * stretch.growth / (z + alpha).max(f64::MIN_POSITIVE);
            Skew { z, y, alpha }
        };
        let mut taps = match &self.form {
            Form::One => vec![RuleTap { tilt: 0.0, width: 1.0, weight: 1.0 }],
            Form::Two(constants) => two(skew, constants).to_vec(),
            Form::Three(constants) => three(skew, constants).to_vec(),
        };
        for tap in &mut taps {
            let tilt = tap.tilt * alpha;
            tap.tilt = tilt / (1.0 + (tilt * stretch.slope).max(0.0));
            tap.width = tap.width.max(NARROWEST);
        }
        taps
    }

    /// What the fetches are expected to be off by in total variation: 0 where there is no stretch
    /// and no growth.
    pub fn expected(&self, stretch: &Stretch, alpha: f64) -> f64 {
        expected::variation(&self.expected.constants, stretch, alpha)
    }

    /// The formula of that, and how far off it is.
    pub fn expectation(&self) -> &Expected {
        &self.expected
    }
}

fn two(skew: impl Fn(f64) -> Skew, constants: &Two) -> [RuleTap; 2] {
    let &[a, c0, c1, c2, e0, e1, e2, n0, n1, f0, f1, w0, w1] = constants;
    let Skew { z, y, alpha } = skew(a);
    let tilt = z * (c0 + c1 * z) / (1.0 + c2 * alpha);
    let width = 1.0 + z * (e0 + e1 * z + e2 * alpha);
    let k = y * (w0 + w1 * z);
    let lean = 0.5 * k / (z * z + k * k).max(f64::MIN_POSITIVE).sqrt();
    [
        RuleTap { tilt: -tilt, width: width + y * (n0 + n1 * z), weight: 0.5 + lean },
        RuleTap { tilt, width: width + y * (f0 + f1 * z), weight: 0.5 - lean },
    ]
}

fn three(skew: impl Fn(f64) -> Skew, constants: &Three) -> [RuleTap; 3] {
    let &[a, b0, b1, c0, c1, c2, d0, d1, e0, e1, e2, e3, n0, n1, f0, f1, g0, g1, g2, w0, w1, h0, h1] =
        constants;
    let Skew { z, y, alpha } = skew(a);
    let over = y / z.max(LEAST_LENGTH);
    let skewed = (over * (b0 + b1 * z)).clamp(0.0, MOST_SKEWED);
    let root = (1.0 + skewed * skewed).sqrt();
    let tilt = (c0 + c1 * z) / (1.0 + c2 * alpha);
    let width = e0 + e1 * z + alpha * (e2 + e3 * z);
    let leaning = (over * (w0 + w1 * z)).clamp(-MOST_SKEWED, MOST_SKEWED);
    let lean = (1.0 + leaning * leaning).sqrt();
    let outer = z * z * (h0 * z + h1 * alpha);
    let share = 1.0 / (1.0 + 2.0 * outer * lean);
    [
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
