//! The view's azimuth: E is even about both axes, so it is a series in cos(2 k b), and
//! tan(phi) = sqrt(alpha_x/alpha_y) tan(b) spreads the dip at the short axis so that the series
//! falls fast.

use std::f64::consts::FRAC_PI_2;

use super::dispatch;
use super::rules::{self, RaysRule};
use crate::integrate::Path;
use crate::integrate::aniso::view::View;
use crate::optics::Smith;
use lobefit_math::ops;

/// A value and the integrand evaluations that it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work {
    /// E.
    pub value: f64,
    /// Integrand evaluations.
    pub evaluations: u64,
}

/// The i-th of `count` values of b in (0, pi/2).
fn node(i: usize, count: usize) -> f64 {
    FRAC_PI_2 * (i as f64 + 0.5) / count as f64
}

/// cos and sin of the azimuth of b.
fn direction(root: f64, b: f64) -> [f64; 2] {
    let (sin_b, cos_b) = ops::sincos(b);
    let (x, y) = (cos_b, root * sin_b);
    let length = (x * x + y * y).sqrt();
    [x / length, y / length]
}

/// E at `count` azimuths, and the evaluations that they took; alpha_x not below alpha_y.
pub(super) fn values(
    path: Path,
    smith: Smith,
    alpha: [f64; 2],
    mu: f64,
    digits: f64,
    count: usize,
) -> (Vec<f64>, u64) {
    let rule = RaysRule::new(smith, alpha, mu, digits);
    let root = (alpha[0] / alpha[1]).sqrt();
    let rays = |i| {
        let azimuth = direction(root, node(i, count));
        dispatch::rays(path, &View::towards(smith, alpha, mu, azimuth), &rule)
    };
    ((0..count).map(rays).collect(), count as u64 * rule.evaluations())
}

/// E at one azimuth of the view.
pub(super) fn at(path: Path, smith: Smith, alpha: [f64; 2], mu: f64, phi: f64, digits: f64) -> Work {
    let (sin_phi, cos_phi) = ops::sincos(phi);
    let (alpha, [x, y]) = ordered(alpha, [cos_phi.abs(), sin_phi.abs()]);
    let rule = RaysRule::new(smith, alpha, mu, digits);
    let value = dispatch::rays(path, &View::towards(smith, alpha, mu, [x, y]), &rule);
    Work { value, evaluations: rule.evaluations() }
}

/// The axes swapped, where need be, so that the second is the short one, as the integral takes it.
fn ordered(alpha: [f64; 2], direction: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    if alpha[0] < alpha[1] {
        return ([alpha[1], alpha[0]], [direction[1], direction[0]]);
    }
    (alpha, direction)
}

/// E averaged over the azimuth.
///
/// The mean over phi of cos(2 k b) is p^k, p = (root - 1)/(root + 1), root = sqrt(alpha_x/alpha_y)
/// (the Fourier series of d phi/d b, a Poisson kernel): so the nodes need to resolve E alone, not d
/// phi/d b.
pub(super) fn mean(path: Path, smith: Smith, alpha: [f64; 2], mu: f64, digits: f64) -> Work {
    let (alpha, _) = ordered(alpha, [1.0, 0.0]);
    let count = rules::azimuths(alpha, digits);
    let (values, evaluations) = values(path, smith, alpha, mu, digits, count);
    let root = (alpha[0] / alpha[1]).sqrt();
    let p = (root - 1.0) / (root + 1.0);
    let mut total = 0.0;
    for (i, value) in values.iter().enumerate() {
        total += weight(p, node(i, count), count) * value;
    }
    Work { value: total / count as f64, evaluations }
}

/// 1 + 2 sum p^k cos(2 k b) over k below `count`.
fn weight(p: f64, b: f64, count: usize) -> f64 {
    let twice = 2.0 * ops::cos(2.0 * b);
    let (mut before, mut cosine) = (1.0, 0.5 * twice);
    let (mut power, mut total) = (p, 1.0);
    for _ in 1..count {
        total += 2.0 * power * cosine;
        power *= p;
        (before, cosine) = (cosine, twice * cosine - before);
    }
    total
}

/// Coefficients of cos(2 k b) from the values at the nodes.
pub(super) fn coefficients(values: &[f64]) -> Vec<f64> {
    let count = values.len();
    let mut out = vec![0.0; count];
    for (k, coefficient) in out.iter_mut().enumerate() {
        let terms = values.iter().enumerate().map(|(i, v)| v * ops::cos(2.0 * k as f64 * node(i, count)));
        let scale = if k == 0 { 1.0 } else { 2.0 };
        *coefficient = scale * terms.sum::<f64>() / count as f64;
    }
    out
}

/// cos(2 b) of an azimuth of the view given by its cosine and sine.
pub(super) fn cos_2b(root: f64, azimuth: [f64; 2]) -> f64 {
    let (x, y) = (root * azimuth[0], azimuth[1]);
    (x - y) * (x + y) / (x * x + y * y)
}
