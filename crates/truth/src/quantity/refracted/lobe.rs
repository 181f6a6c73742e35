//! The lobe that a rough interface refracts, about the refraction at the mean normal.
//!
//! With the view v = (sin, 0, mu) outside, N = (0, 0, 1) and n the index of refraction, the axis is
//! t = (-s_t, 0, -c_t) by Snell's law, and a light inside is l = cos(theta) t + sin(theta) (e cos(phi) +
//! y sin(phi)), e = (c_t, 0, -s_t). The facet that refracts v into l lies along H = -(v + n l) (Walter
//! et al. 2007, eq. 16), which cancels where n is near 1; without cancellation, with q = n c_t - mu =
//! (n^2 - 1)/(n c_t + mu),
//!
//!   H = q N + n (2 sin^2(theta/2) t - sin(theta) (e cos(phi) + y sin(phi))).
//!
//! Energy per solid angle is Walter's eq. 21 times |l.N|. |v + n l| is |H|, of which every power but
//! those in D cancels: n^2 (v.H) (-l.H) (1 - F) G2/mu D/|H|^4, and D/|H|^4 = alpha^2/(pi (H_x^2 + H_y^2 +
//! alpha^2 H_z^2)^2). It lives where H_z and v.H are positive; both are linear in cos(phi), so that
//! a ring of lights at one theta has one interval of phi.

use std::f64::consts::PI;

use multiversion::multiversion;

use crate::integrate::{Integrand, PanelRule};
use crate::optics::fresnel;
use crate::optics::{Smith, ggx};
use lobefit_math::lanes::{self, F8, LANES};
use lobefit_math::{ops, panels};

/// Longest panel in u.
const LONGEST: f64 = 3.0;

/// The lobe of a view.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lobe {
    smith: Smith,
    alpha: f64,
    mu: f64,
    ior: f64,
    /// (n - 1) (n + 1).
    excess: f64,
    /// cos and sin of the axis to -N.
    axis: [f64; 2],
    /// q.
    lift: f64,
    /// cos and sin of the angle from -v to the axis.
    bend: [f64; 2],
    /// Projected area of the facets about the view.
    area: f64,
}

/// A ring of lights.
#[derive(Clone, Copy, Debug)]
struct Ring {
    /// sin(theta) and 2 sin^2(theta/2).
    sine: f64,
    fall: f64,
}

impl Lobe {
    pub fn new(smith: Smith, alpha: f64, mu: f64, ior: f64) -> Lobe {
        let sine = ((1.0 - mu) * (1.0 + mu)).sqrt();
        let excess = (ior - 1.0) * (ior + 1.0);
        let (c_t, s_t) = ((excess + mu * mu).sqrt() / ior, sine / ior);
        let lift = excess / (ior * c_t + mu);
        // sin(i - t) = sin(i) (c_t - mu/n)
        let bend = [sine * s_t + mu * c_t, sine * lift / ior];
        let area = ggx::stretched_length(alpha, mu);
        Lobe { smith, alpha, mu, ior, excess, axis: [c_t, s_t], lift, bend, area }
    }

    /// Its inputs, in messages.
    pub fn place(&self) -> String {
        format!("alpha = {:?}, mu = {:?}, ior = {:?}", self.alpha, self.mu, self.ior)
    }

    /// tan(theta/2) = width sinh(u): facets deviate a narrow lobe by q/n of their tilt across the
    /// plane of incidence.
    pub fn width(&self) -> f64 {
        0.5 * self.alpha * self.lift / self.ior
    }

    /// Cuts of u, from the axis to the last light, with panels down to `finest` where rings turn from whole
    /// to truncated.
    pub fn cuts(&self, finest: f64) -> Vec<f64> {
        let [refracted, bend] = [self.axis, self.bend].map(|[cosine, sine]| ops::atan2(sine, cosine));
        let horizon = ops::atan2((self.excess + 1.0 - self.mu * self.mu).sqrt(), self.mu);
        let grazing = ops::atan2(self.excess.sqrt(), 1.0);
        let last = (horizon + refracted).min(grazing + bend);
        let u = |angle: f64| ops::asinh(ops::tan(0.5 * angle) / self.width());
        let mut breaks = vec![0.0, u(last)];
        let inner = [horizon - refracted, grazing - bend];
        breaks.extend(inner.into_iter().filter(|angle| (0.0..last).contains(angle)).map(u));
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|b, a| *b - *a < finest);
        let mut cuts = vec![0.0];
        for pair in breaks.windows(2) {
            // About the axis itself nothing turns.
            let first = if pair[0] == 0.0 { LONGEST } else { finest };
            panels::towards_both(&mut cuts, pair[0], pair[1], LONGEST, [first, finest]);
        }
        cuts
    }

    /// The energy of a ring over u.
    pub fn ring(&self, u: f64, rule: &PanelRule) -> f64 {
        // sinh(u) and cosh(u) of one exponential.
        let e = ops::expm1(u);
        let rest = e / (1.0 + e);
        let t = self.width() * 0.5 * (e + rest);
        let inverse = 1.0 / (1.0 + t * t);
        let ring = Ring { sine: 2.0 * t * inverse, fall: 2.0 * t * t * inverse };
        let [from, to] = self.lit(&ring);
        if to <= from {
            return 0.0;
        }
        let half = energy(self, &ring, [from, to], rule);
        // d theta/du = 2 width cosh(u)/(1 + t^2)
        2.0 * half * ring.sine * 2.0 * self.width() * (1.0 + 0.5 * e * rest) * inverse
    }

    /// The azimuths of a ring, in [0, pi], at which facets refract into it.
    fn lit(&self, ring: &Ring) -> [f64; 2] {
        let ([c_t, s_t], [cosine, sine]) = (self.axis, self.bend);
        // H_z = q - n (c_t fall - s_t sin(theta) cos(phi)),
        // v.H = q mu - n (cos fall + sin sin(theta) cos(phi)).
        let least = ratio(c_t * ring.fall - self.lift / self.ior, s_t * ring.sine);
        let most = ratio(self.lift * self.mu / self.ior - cosine * ring.fall, sine * ring.sine);
        [most, least].map(|cosine| ops::acos(cosine.clamp(-1.0, 1.0)))
    }
}

/// The energy of half a ring per sin(theta), compiled for the instructions that the processor has: every
/// form does the same operations in the same order.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
fn energy(lobe: &Lobe, ring: &Ring, [from, to]: [f64; 2], rule: &PanelRule) -> f64 {
    2.0 * PI * rule.panel_of(from / (2.0 * PI), to / (2.0 * PI), &Azimuth { lobe, ring })
}

/// Energy per solid angle along a ring.
struct Azimuth<'a> {
    lobe: &'a Lobe,
    ring: &'a Ring,
}

impl Integrand for Azimuth<'_> {
    #[inline(always)]
    fn at(&self, turns: &F8) -> F8 {
        let (Lobe { smith, alpha, mu, ior, excess, area, lift, .. }, Ring { sine: reach, fall }) =
            (*self.lobe, *self.ring);
        let ([c_t, s_t], [cos_b, sin_b]) = (self.lobe.axis, self.lobe.bend);
        let (eta, contrast) = (1.0 / ior, excess / (ior * ior));
        let (sine, cosine) = lanes::sincos_turns(turns);
        let mut out = [0.0; LANES];
        for i in 0..LANES {
            let x = -ior * (s_t * fall + c_t * reach * cosine[i]);
            let y = ior * reach * sine[i];
            let z = lift - ior * (c_t * fall - s_t * reach * cosine[i]);
            let to_view = (lift * mu - ior * (cos_b * fall + sin_b * reach * cosine[i])).max(0.0);
            let to_light = (excess - to_view) * eta;
            let across = x * x + y * y;
            let length = 1.0 / (across + z * z).sqrt();
            let (c, c_l) = ((to_view * length).min(1.0), (to_light * length).min(1.0));
            let passed = 1.0 - fresnel::unpolarised(eta, contrast, c, (1.0 - c) * (1.0 + c), c_l);
            let mu_l = ((z + mu) * eta).clamp(0.0, 1.0);
            let seen = smith.shadowing_over_cosine(mu, area, mu_l, ggx::stretched_length(alpha, mu_l));
            let a = alpha / (across + alpha * alpha * z * z);
            out[i] = ior * ior * to_view * to_light * passed * seen * a * a / PI;
        }
        out
    }
}

/// a/b, b >= 0; infinite where b is 0, by the sign of a.
fn ratio(a: f64, b: f64) -> f64 {
    if b > 0.0 {
        a / b
    } else if a > 0.0 {
        f64::INFINITY
    } else {
        f64::NEG_INFINITY
    }
}
