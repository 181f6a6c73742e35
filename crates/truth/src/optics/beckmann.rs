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

/// k from which moments are taken from [`BEYOND`]. Below it differences of the series lose two digits at
/// most.
const SERIES_TO: f64 = 8.0;

/// Terms of the series of Bessel functions, of which 1e-16 is left at [`SERIES_TO`].
const SERIES: usize = 25;

/// 1/(m! (m + order)!): I_order(k) = (k/2)^order sum of these times (k^2/4)^m.
const fn series(order: usize) -> [f64; SERIES] {
    let mut terms = [1.0; SERIES];
    let mut m = 1;
    while m < SERIES {
        terms[m] = terms[m - 1] / (m * (m + order)) as f64;
        m += 1;
    }
    terms
}

/// Of I_0 and I_1.
const BESSEL: [[f64; SERIES]; 2] = [series(0), series(1)];

/// sqrt(k) times each moment as a polynomial in 16/k - 1, k >= 8, each within 2e-15 of itself: interpolated
/// at 60 Chebyshev nodes in 40 digits, from Bessel functions (mpmath 1.3), and cut off.
const BEYOND: (&[f64], &[f64], &[f64]) = (
    &[
        0.40217650944500843,
        0.0033605519836670235,
        0.00013621607432248806,
        1.1143033854011811e-05,
        1.4838499636290073e-06,
        2.973584533150965e-07,
        8.868971262015967e-08,
        3.9340297511352995e-08,
        2.1775469505877374e-08,
        7.472268704900415e-09,
        -7.680769979077281e-09,
        -1.312290013299317e-08,
        -2.9882808619860748e-09,
        6.919159946153143e-09,
        3.3388464317980515e-09,
        -2.5947610525034172e-09,
        -1.3585917245471386e-09,
        6.763382929319093e-10,
        2.3233300175998502e-10,
        -8.979705022846649e-11,
    ],
    &[
        0.20444880670617202,
        0.005313260124284551,
        0.0003739692873137102,
        4.493600863665816e-05,
        8.16411524786671e-06,
        2.167809465625128e-06,
        8.519386015914861e-07,
        4.6736867924784963e-07,
        2.5151567921953947e-07,
        4.023977431353929e-09,
        -2.2046304493729935e-07,
        -2.1789570544371127e-07,
        3.844312458665279e-08,
        2.027627008418302e-07,
        3.6131880262588985e-08,
        -1.437662744859691e-07,
        -4.154777345076594e-08,
        8.522188634511827e-08,
        2.3423601810895627e-08,
        -3.8468763166290566e-08,
        -7.578347333575168e-09,
        1.1235603980260556e-08,
        1.1056728082354416e-09,
        -1.5470798888304958e-09,
    ],
    &[
        0.3119864701835445,
        0.014031088885391734,
        0.0014437005309629945,
        0.0002348684944295054,
        5.5741707649356905e-05,
        1.9202557869214674e-05,
        9.660613993328482e-06,
        5.982440393488723e-06,
        2.430659969874442e-06,
        -2.144104304632269e-06,
        -4.96215116322736e-06,
        -2.351388362289302e-06,
        3.2693343455135804e-06,
        3.729062877231052e-06,
        -1.8894418334740686e-06,
        -3.642183851293725e-06,
        1.235335173183834e-06,
        2.8742530304825016e-06,
        -8.9245838590203e-07,
        -1.7869898405660632e-06,
        5.755261589601081e-07,
        8.007083084988506e-07,
        -2.7307155184619694e-07,
        -2.251333557038102e-07,
        8.045855051014137e-08,
        2.9450590498282962e-08,
        -1.0873163400409454e-08,
    ],
);

/// exp(-steep) times the means over psi of x^n exp(-x), x = k (1 - cos psi), for n = 0, 1, 2 and k >= 0: with
/// scaled Bessel functions I_0, k (I_0 - I_1) and k^2 (2 (I_0 - I_1) - I_1/k). For large k they are 1, 1/2
/// and 3/4 of 1/sqrt(2 pi k).
fn moments(k: f64, steep: f64) -> [f64; 3] {
    let horner = |terms: &[f64], x: f64| terms.iter().rev().fold(0.0, |sum, term| sum * x + term);
    if k < SERIES_TO {
        let [zero, one] = BESSEL.map(|terms| horner(&terms, 0.25 * k * k));
        let (scale, apart) = (gauss(steep + k), zero - 0.5 * k * one);
        return [zero, k * apart, k * k * (2.0 * apart - 0.5 * one)].map(|moment| scale * moment);
    }
    let (scale, y) = (gauss(steep) / k.sqrt(), 2.0 * SERIES_TO / k - 1.0);
    [horner(BEYOND.0, y), horner(BEYOND.1, y), horner(BEYOND.2, y)].map(|moment| scale * moment)
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

    /// With tan^2 = tan^2(D/2) + alpha^2 k (1 - cos psi), k = sin(theta) sin(theta_l)/(2 alpha^2 cos^2(S/2)
    /// cos^2(D/2)), D is (1 + tan^2)^2 exp(-tan^2/alpha^2)/(pi alpha^2), and its integral a sum of
    /// `moments`.
    fn azimuth_integral(self, polar: &Polar) -> f64 {
        let (a2, cos2) = (self.0 * self.0, polar.cos_d * polar.cos_d);
        let steep = polar.sin_d * polar.sin_d / (a2 * cos2);
        if steep > Self::REACH * Self::REACH || steep.is_nan() {
            return 0.0;
        }
        let (sum, difference) = (polar.sin_s * polar.cos_d, polar.cos_s * polar.sin_d);
        let swing = (sum + difference) * (sum - difference);
        let k = if swing > 0.0 { 0.5 * swing / (a2 * cos2 * polar.cos_s * polar.cos_s) } else { 0.0 };
        let [zeroth, first, second] = moments(k, steep);
        2.0 * ((zeroth / cos2 + 2.0 * a2 * first) / (a2 * cos2) + a2 * second)
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
