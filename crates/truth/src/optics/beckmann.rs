//! The Beckmann distribution (Beckmann and Spizzichino 1963; Walter et al. 2007, eqs. 25 to 29),
//! isotropic: slopes of facets are normal with variance alpha^2/2 along either axis. With
//! c = mu/(alpha sin theta) (Heitz 2014, eq. 68)
//!
//!   Lambda = (exp(-c^2)/(c sqrt(pi)) - erfc(c))/2,
//!   s = mu (1 + 2 Lambda) = mu erf(c) + alpha sin(theta) exp(-c^2)/sqrt(pi),
//!   s - mu = alpha sin(theta) ierfc(c),
//!   ierfc(c) = exp(-c^2)/sqrt(pi) - c erfc(c), the integral of erfc beyond c.
//!
//! Ends: s = alpha/sqrt(pi) at grazing view, s = mu at normal incidence.

use std::f64::consts::PI;

use super::distribution::{Distribution, Polar};
use super::ggx::Vec3;
use lobefit_math::{lanes, ops};

/// Beckmann's distribution of a width alpha above 0.
#[derive(Clone, Copy, Debug)]
pub struct Beckmann(pub f64);

/// 1/sqrt(pi).
const INVERSE_ROOT_PI: f64 = 0.564_189_583_547_756_3;

/// c from which ierfc is taken from its continued fraction: below it the difference loses a digit
/// at most.
const FRACTION_FROM: f64 = 2.0;

/// Terms of the continued fraction times c^2: n of them leave exp(-2 c sqrt(2 n)) of it, here exp(-50).
const TERMS: f64 = 320.0;

/// Slopes beyond which exp(-x^2) is 0 beside 1.
const STEEPEST: f64 = 6.5;

/// Newton's steps or, where one leaves the interval, halvings: more than are taken.
const STEPS: usize = 100;

impl Beckmann {
    /// c of a direction; infinite at normal incidence.
    fn c(self, cosine: f64, sine: f64) -> f64 {
        cosine / (self.0 * sine)
    }
}

/// exp(-x) for x >= 0, within 2 ulp, in a quarter of the time that [`ops::exp`] takes where `lanes` reaches.
#[inline]
fn gauss(x: f64) -> f64 {
    if x <= 700.0 { lanes::exp_of(-x) } else { ops::exp(-x) }
}

/// exp(-c^2)/sqrt(pi) - c erfc(c) for c >= 0. With erfc(c) = exp(-c^2)/sqrt(pi)/K(c),
/// K = c + (1/2)/(c + (2/2)/(c + (3/2)/(c + ...))) (Abramowitz & Stegun, 7.1.14), it is
/// exp(-c^2)/sqrt(pi) (K - c)/K, without cancellation.
fn ierfc(c: f64) -> f64 {
    let gauss = INVERSE_ROOT_PI * gauss(c * c);
    if c < FRACTION_FROM {
        return gauss - c * ops::erfc(c);
    }
    // Few at large c, where most directions of a smooth surface are.
    let terms = (TERMS / (c * c)) as u32 + 3;
    let rest = (1..=terms).rev().fold(0.0, |rest, k| 0.5 * f64::from(k) / (c + rest));
    gauss * rest / (c + rest)
}

/// exp(c^2) ierfc(c) as a polynomial in y = 2/(1 + 0.4 c) - 1, interpolated at Chebyshev's 400 nodes and cut
/// off where 1e-11 is left.
const SCALED: [f64; 16] = [
    0.037173673387425714,
    0.12468998538065962,
    0.17536886737820243,
    0.14133148824509295,
    0.07144477618369896,
    0.01837726128348369,
    -0.0017869501825390267,
    -0.002628768469369131,
    -0.00013249460249299412,
    0.00037972809474339045,
    2.891742673437387e-05,
    -6.457856168534894e-05,
    -1.8060752383530468e-06,
    1.0851864506441467e-05,
    -1.9174804991082562e-07,
    -1.1760664695079435e-06,
];

/// ierfc of c >= 0 within 1e-11, without a branch: for loops over lanes.
#[inline(always)]
pub(crate) fn ierfc_near(c: f64) -> f64 {
    let y = 2.0 / (1.0 + 0.4 * c) - 1.0;
    let mut sum = 0.0;
    for term in SCALED.iter().rev() {
        sum = sum * y + term;
    }
    sum * falling(c * c)
}

/// exp(-x) for x >= 0, and 0 where that is below 1e-34, without a branch.
#[inline(always)]
pub(crate) fn falling(x: f64) -> f64 {
    let inside = x < 80.0;
    let value = lanes::exp_of(if inside { -x } else { -80.0 });
    if inside { value } else { 0.0 }
}

impl Distribution for Beckmann {
    /// exp(-28^2) is 0.
    const REACH: f64 = 28.0;

    fn alpha(self) -> f64 {
        self.0
    }

    fn density(self, normal: Vec3) -> f64 {
        let cos2 = normal[2] * normal[2];
        let tan2 = (normal[0] * normal[0] + normal[1] * normal[1]) / cos2;
        let a2 = self.0 * self.0;
        ops::exp(-tan2 / a2) / (PI * a2 * cos2 * cos2)
    }

    /// With h of |v + l|^2/4 = cos^2(S/2) + t, tan^2 = (cos^2(S/2) sin^2(D/2) + t)/(cos^2(S/2)
    /// cos^2(D/2)).
    fn density_of_half(self, polar: &Polar, t: f64) -> f64 {
        let a2 = self.0 * self.0;
        let (near, cos2) = (polar.cos_s * polar.cos_s, polar.cos_d * polar.cos_d);
        let tan2 = (near * polar.sin_d * polar.sin_d + t) / (near * cos2);
        let exponent = tan2 / a2;
        if exponent > Self::REACH * Self::REACH || exponent.is_nan() {
            return 0.0;
        }
        let ratio = (1.0 + tan2) / a2;
        ratio * ratio * gauss(exponent)
    }

    fn fall(self, polar: &Polar) -> f64 {
        let product = self.0 * polar.cos_s * polar.cos_d;
        (product * product).max(f64::MIN_POSITIVE)
    }

    fn area(self, cosine: f64, sine: f64) -> f64 {
        cosine + self.lift(cosine, sine, cosine)
    }

    fn lift(self, cosine: f64, sine: f64, _: f64) -> f64 {
        let c = self.c(cosine, sine);
        if c < Self::REACH { self.0 * sine * ierfc(c) } else { 0.0 }
    }

    /// Slopes visible from the stretched view at angle theta: y is normal, and x along the view has
    /// density (1 - x tan theta) exp(-x^2) up to cot theta, inverted by Newton's method.
    fn visible_normal(self, view: Vec3, u: f64, v: f64) -> Vec3 {
        let stretched = [self.0 * view[0], self.0 * view[1], view[2]];
        let across = (stretched[0] * stretched[0] + stretched[1] * stretched[1]).sqrt();
        let (cos_phi, sin_phi) =
            if across > 0.0 { (stretched[0] / across, stretched[1] / across) } else { (1.0, 0.0) };
        let (x, y) = (slope(across / stretched[2], u), slope(0.0, v));
        // The facet of slopes (x, y) towards the view has the normal (-x, -y, 1).
        let normal = [-self.0 * (cos_phi * x - sin_phi * y), -self.0 * (sin_phi * x + cos_phi * y), 1.0];
        let length = (normal[0] * normal[0] + normal[1] * normal[1] + 1.0).sqrt();
        normal.map(|k| k / length)
    }

    /// The part 1 - exp(-r^2) of all normals has slopes within alpha r of 0.
    fn normal(self, u: f64, v: f64) -> Vec3 {
        let (sine, cosine) = ops::sincos(2.0 * PI * u);
        let radius = self.0 * (-ops::log1p(-v)).sqrt();
        let length = (1.0 + radius * radius).sqrt();
        [radius * cosine / length, radius * sine / length, 1.0 / length]
    }
}

/// The slope below which a part `u` of (1 - x tan) exp(-x^2), x <= 1/tan, lies.
fn slope(tangent: f64, u: f64) -> f64 {
    let below = |x: f64| 0.5 * (ops::erfc(-x) / INVERSE_ROOT_PI + tangent * ops::exp(-x * x));
    let (mut low, mut high) = (-STEEPEST, STEEPEST.min(1.0 / tangent));
    let wanted = u * below(high);
    let mut x = 0.5 * (low + high);
    for _ in 0..STEPS {
        let off = below(x) - wanted;
        if off > 0.0 {
            high = x
        } else {
            low = x
        }
        let newton = x - off / ((1.0 - x * tangent) * ops::exp(-x * x));
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 1e-14 {
            return next;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_short_form_is_near_the_long_one() {
        for i in 0..2000 {
            let c = f64::from(i) * 0.01;
            let (short, long) = (ierfc_near(c), ierfc(c));
            assert!((short - long).abs() < 1e-11, "{c}: {short} {long}");
        }
        assert_eq!((ierfc_near(f64::INFINITY), falling(f64::INFINITY)), (0.0, 0.0));
    }
}
