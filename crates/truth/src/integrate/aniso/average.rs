//! The mean over the view's azimuth: a periodic trapezoid in b, tan(phi) = sqrt(alpha_x/alpha_y)
//! tan(b), over one quadrant (E is even about both axes). The variable spreads the dip at the short
//! axis, so that the rule converges geometrically.

use super::rays::Rays;
use super::view::View;
use crate::integrate::PanelRule;
use crate::optics::Smith;
use lobefit_math::ops;

/// Digits of the rule of eight nodes, as a multiple of the strip's width: the trapezoid's error is
/// exp(-4 strip count).
const NODES: f64 = 14.0;

/// E and loss, averaged over the azimuth; a finer rule has more azimuths in proportion.
pub(super) fn mean(smith: Smith, alpha: [f64; 2], mu: f64, rule: &PanelRule) -> [f64; 2] {
    let ratio = (alpha[0] / alpha[1]).max(alpha[1] / alpha[0]);
    let root = (alpha[0] / alpha[1]).sqrt();
    // The integrand's strip of analyticity in b has half width atanh(sqrt(min/max)) (numerics:
    // 14/(4 atanh)).
    let strip = if ratio > 1.0 { atanh((1.0 / ratio).sqrt()) } else { f64::INFINITY };
    let count = ((NODES / (4.0 * strip)).ceil().max(2.0) as usize) * (rule.nodes() / 8);
    let mut total = [0.0; 2];
    for i in 0..count {
        let b = 0.5 * std::f64::consts::PI * (i as f64 + 0.5) / count as f64;
        let (sin_b, cos_b) = ops::sincos(b);
        let (x, y) = (cos_b, root * sin_b);
        let length2 = x * x + y * y;
        let length = length2.sqrt();
        // d phi / d b = root / (cos^2 b + root^2 sin^2 b)
        let weight = root / length2;
        let value = Rays::new(View::towards(smith, alpha, mu, [x / length, y / length])).albedo(rule);
        total[0] += weight * value[0];
        total[1] += weight * value[1];
    }
    total.map(|x| x / count as f64)
}

fn atanh(x: f64) -> f64 {
    0.5 * (ops::log1p(x) - ops::log1p(-x))
}
