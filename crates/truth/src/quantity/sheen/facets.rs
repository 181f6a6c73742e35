//! The sheen integral over the microfacets that mirror the view into the light.
//!
//! With p = 1/alpha, facets at polar angle theta_h and azimuth phi from the view, y = v.h and
//! mu_l = 2 y cos(theta_h) - mu, the light's solid angle is 4 y times the facet's and
//!
//!   E = (2 + p)/(2 pi) int sin^(p + 1)(theta_h) 2 R(theta_h) dtheta_h,
//!   R = int_0^phi_m y mu_l/(mu^2 + 2 kappa y cos(theta_h)) dphi,
//!
//! kappa = 1 - mu. R does not depend on alpha, and its integrand is rational in cos(phi): with
//! a = 2 cos(theta_h), P = mu^2 + kappa a mu cos(theta_h), Q = kappa a sin(theta) sin(theta_h) and
//! T = tan(phi_m/2) it is, by division of polynomials in y,
//!
//!   R = [mu cos(theta_h) phi_m + sin(theta) sin(theta_h) sin(phi_m) - mu/(kappa a) (phi_m - mu^2 J)]/kappa,
//!   J = int_0^phi_m dphi/(P + Q cos(phi)) = 2/(P + Q) T f(T^2 (P - Q)/(P + Q)),
//!   f(u) = atan(sqrt(u))/sqrt(u).
//!
//! The horizon mu_l = 0 ends the azimuth at cos(phi_m) = -cot(theta) cot(2 theta_h). With
//! eps = pi/2 - theta and tau = tan(eps/2) there are three ranges, each in a variable in which its
//! integrand is analytic to a distance of pi/2:
//! - `High`: tan(pi/2 - theta_h) = tau cosh(w), from the last facet that mirrors above the horizon
//!   (w = 0, phi_m = 0) to pi/4;
//! - `Low`: tan(theta_h) = tau cosh(w), from pi/4 to the facet whose ring just touches the horizon
//!   (w = 0, phi_m = pi);
//! - `Full`: tan(theta_h) = tau e^-z, rings that are lit all around.
//!
//! The sine's power spans many orders: each range is cut where it has fallen by given factors, and
//! left where it has fallen by e^-45.

use super::lobe::{self, exponent};
use super::shadowed::Lambda;
use crate::integrate::PanelRule;
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Cosines below this are it: E differs from its limit by 1e-14 of itself at most, for every alpha
/// of the domain.
const GRAZING: f64 = 1e-18;

/// Longest panel: n nodes leave 3.4^-2n beside singularities at a distance of pi/2.
const LONGEST: f64 = 2.0;

/// Falls of the sine's power, as exponents of 1/e, at which a range is cut; beyond the last it is
/// left out.
const FALLS: [f64; 4] = [5.0, 14.0, 27.0, 45.0];

/// Below this kappa the closed form of R cancels (by 1/kappa^2), and its integrand has no pole
/// near.
const CLOSED_KAPPA: f64 = 0.1;

/// Below this phi_m the closed form cancels (R falls with its cube), and the pole is at five times
/// it or farther.
const CLOSED_AZIMUTH: f64 = 0.5;

/// Terms of f's series; |u| is below [`SERIES_BELOW`], so that the rest is below 1e-17.
const SERIES_TERMS: i32 = 13;
const SERIES_BELOW: f64 = 0.06;

/// A view of the lobe.
#[derive(Clone, Copy, Debug)]
pub(super) struct View<'a> {
    p: f64,
    mu: f64,
    sine: f64,
    kappa: f64,
    /// tau and 1 - tau.
    tau: f64,
    rest: f64,
    /// The shadowing in place of Neubelt's visibility.
    shadowing: Option<Shadowing<'a>>,
}

/// Shadowing by Lambda, seen from a view: no azimuth of it has a closed form.
#[derive(Clone, Copy, Debug)]
struct Shadowing<'a> {
    lambda: &'a Lambda,
    /// Lambda of the view.
    of_view: f64,
    /// Rule of each part of the azimuth.
    rule: &'static Gauss,
}

/// A ring of facets: cos and sin of theta_h, the azimuth that it ends at and the tangent of half of
/// that.
#[derive(Clone, Copy, Debug)]
struct Ring {
    cosine: f64,
    sine: f64,
    azimuth: f64,
    tangent: f64,
}

impl<'a> View<'a> {
    /// alpha > 0, mu in [0, 1].
    pub(super) fn new(alpha: f64, mu: f64) -> View<'a> {
        let mu = mu.max(GRAZING);
        let kappa = 1.0 - mu;
        let sine = (kappa * (1.0 + mu)).sqrt();
        let below = 1.0 + sine;
        let (tau, rest) = (mu / below, (sine + kappa) / below);
        View { p: exponent(alpha), mu, sine, kappa, tau, rest, shadowing: None }
    }

    /// The same with the shadowing of a Lambda, that of the width; mu > 0.
    pub(super) fn shadowed(lambda: &'a Lambda, mu: f64, rule: &'static Gauss) -> View<'a> {
        let shadowing = Some(Shadowing { lambda, of_view: lambda.fitted.at(mu), rule });
        View { shadowing, ..View::new(lambda.fitted.alpha, mu) }
    }

    /// -ln of the sine's power where it is largest.
    pub(super) fn exponent(&self) -> f64 {
        0.5 * (self.p + 1.0) * ops::log1p(self.tau * self.tau)
    }

    /// E by one rule.
    pub(super) fn albedo(&self, rule: &PanelRule) -> f64 {
        let (high, ends) = self.high_cuts();
        let mut sum = integral(rule, &high, |w| self.high(w));
        if !ends {
            sum += integral(rule, &self.low_cuts(), |w| self.low(w));
            sum += integral(rule, &self.full_cuts(), |z| self.full(z));
        }
        (2.0 + self.p) / PI * sum
    }

    /// w at the angle pi/4: cosh(w) = 1/tau.
    fn middle(&self) -> f64 {
        ops::log((1.0 + (self.rest * (1.0 + self.tau)).sqrt()) / self.tau)
    }

    /// Cuts of `High`, and whether the sine's power has fallen away before pi/4.
    fn high_cuts(&self) -> (Vec<f64>, bool) {
        // 1 + t^2 = (1 + tau^2) e^(2 fall/(p + 1)), t = tau cosh(w)
        let at = |fall: f64| {
            let growth = (1.0 + self.tau * self.tau) * ops::expm1(2.0 * fall / (self.p + 1.0));
            ops::asinh(growth.sqrt() / self.tau)
        };
        let middle = self.middle();
        (cuts(&FALLS.map(at), middle), at(FALLS[3]) < middle)
    }

    /// Cuts of `Low`, from pi/4 on in middle - w.
    fn low_cuts(&self) -> Vec<f64> {
        // 1 + 1/t^2 = 2 e^(2 fall/(p + 1))
        let at = |fall: f64| {
            let t = 1.0 / (2.0 * ops::exp(2.0 * fall / (self.p + 1.0)) - 1.0).sqrt();
            if t > self.tau { self.middle() - ops::acosh(t / self.tau) } else { f64::INFINITY }
        };
        cuts(&FALLS.map(at), self.middle())
    }

    /// Cuts of `Full`.
    fn full_cuts(&self) -> Vec<f64> {
        // 1 + 1/t^2 = (1 + 1/tau^2) e^(2 fall/(p + 1)), t = tau e^-z
        let square = self.tau * self.tau;
        let at = |fall: f64| 0.5 * ops::log1p((1.0 + square) * ops::expm1(2.0 * fall / (self.p + 1.0)));
        cuts(&FALLS.map(at), at(FALLS[3]))
    }

    /// Integrand of `High`.
    fn high(&self, w: f64) -> f64 {
        let (t, slope, tangent) = self.horizon(w);
        let length2 = 1.0 + t * t;
        let length = length2.sqrt();
        let ring =
            Ring { cosine: t / length, sine: 1.0 / length, azimuth: 2.0 * ops::atan(tangent), tangent };
        let power = ops::exp(-0.5 * (self.p + 1.0) * ops::log1p(t * t));
        power * self.ring(&ring) * slope / length2
    }

    /// Integrand of `Low`, over middle - w.
    fn low(&self, from_middle: f64) -> f64 {
        let (t, slope, tangent) = self.horizon((self.middle() - from_middle).max(0.0));
        let length2 = 1.0 + t * t;
        let length = length2.sqrt();
        let tangent = 1.0 / tangent;
        let ring =
            Ring { cosine: 1.0 / length, sine: t / length, azimuth: 2.0 * ops::atan(tangent), tangent };
        self.power_of_tangent(t) * self.ring(&ring) * slope / length2
    }

    /// Integrand of `Full`.
    fn full(&self, z: f64) -> f64 {
        let t = self.tau * ops::exp(-z);
        let length2 = 1.0 + t * t;
        let length = length2.sqrt();
        let ring = Ring { cosine: 1.0 / length, sine: t / length, azimuth: PI, tangent: f64::INFINITY };
        self.power_of_tangent(t) * self.ring(&ring) * t / length2
    }

    /// sin^(p + 1) of an angle from its tangent.
    fn power_of_tangent(&self, t: f64) -> f64 {
        ops::exp((self.p + 1.0) * (ops::log(t) - 0.5 * ops::log1p(t * t)))
    }

    /// t = tau cosh(w), dt/dw, and tan(phi_m/2) of the ring at pi/2 - atan(t):
    /// tan^2(phi_m/2) = tanh^2(w/2) (1 + tau^2 cosh(w))/(1 - tau^2 cosh(w)).
    fn horizon(&self, w: f64) -> (f64, f64, f64) {
        let (half, square) = (ops::sinh(0.5 * w), self.tau * self.tau);
        let grown = 2.0 * half * half;
        let (above, below) = (1.0 + square * (1.0 + grown), self.rest * (1.0 + self.tau) - square * grown);
        let tangent = ops::tanh(0.5 * w) * (above / below).sqrt();
        (self.tau * (1.0 + grown), self.tau * ops::sinh(w), tangent)
    }

    /// R of a ring.
    fn ring(&self, ring: &Ring) -> f64 {
        if let Some(shadowing) = &self.shadowing {
            self.ring_shadowed(ring, shadowing)
        } else if self.kappa < CLOSED_KAPPA || ring.azimuth < CLOSED_AZIMUTH {
            self.ring_summed(ring)
        } else {
            self.ring_closed(ring)
        }
    }

    fn ring_closed(&self, ring: &Ring) -> f64 {
        let View { mu, kappa, .. } = *self;
        let a = 2.0 * ring.cosine;
        let (fixed, swing) = (mu * ring.cosine, self.sine * ring.sine);
        let (p, q) = (mu * mu + kappa * a * fixed, kappa * a * swing);
        let full = ring.tangent.is_infinite();
        let j =
            if full { PI / ((p - q) * (p + q)).sqrt() } else { self.inverse_integral(p, q, ring.tangent) };
        let sine = if full { 0.0 } else { 2.0 * ring.tangent / (1.0 + ring.tangent * ring.tangent) };
        let first = fixed * ring.azimuth + swing * sine;
        (first - mu / (kappa * a) * (ring.azimuth - mu * mu * j)) / kappa
    }

    /// J. Where P < Q, f is atanh(r T)/(r T) with r^2 = (Q - P)/(P + Q), and 1 - r^2 T^2 = mu
    /// (1 + T^2)/(P + Q), for at the horizon P + Q cos(phi_m) = mu.
    fn inverse_integral(&self, p: f64, q: f64, tangent: f64) -> f64 {
        let (sum, t2) = (p + q, tangent * tangent);
        let u = t2 * (p - q) / sum;
        let f = if u.abs() < SERIES_BELOW {
            (0..SERIES_TERMS).rev().fold(0.0, |rest, k| 1.0 / f64::from(2 * k + 1) - u * rest)
        } else if u > 0.0 {
            ops::atan(u.sqrt()) / u.sqrt()
        } else {
            let root = (-u).sqrt();
            (ops::log1p(root) - 0.5 * ops::log(self.mu * (1.0 + t2) / sum)) / root
        };
        2.0 * tangent * f / sum
    }

    /// R by a rule over the azimuth.
    fn ring_summed(&self, ring: &Ring) -> f64 {
        static RULE: LazyLock<Gauss> = LazyLock::new(|| Gauss::new(20));
        let light = self.lights(ring);
        RULE.integrate(0.0, ring.azimuth, |phi| {
            let (y, mu_l) = light(phi);
            y * lobe::lit(self.mu, mu_l)
        })
    }

    /// R with G2/mu in place of mu_l/(mu^2 + 2 kappa y cos(theta_h)), in two parts: up to the light
    /// at a cosine of 1/2, where Lambda is no smooth function, and from there by phi = end - length
    /// t^4, for Lambda is one of a small power of mu_l.
    fn ring_shadowed(&self, ring: &Ring, shadowing: &Shadowing) -> f64 {
        let light = self.lights(ring);
        let value = |phi: f64| {
            let (y, mu_l) = light(phi);
            y / (self.mu * (1.0 + shadowing.of_view + shadowing.lambda.at(mu_l.clamp(0.0, 1.0))))
        };
        let swing = self.sine * ring.sine;
        let middle = (0.5 * (self.mu + 0.5) / ring.cosine - self.mu * ring.cosine) / swing;
        let cut =
            if middle < 1.0 { ops::atan2((1.0 - middle * middle).max(0.0).sqrt(), middle) } else { 0.0 };
        let (cut, rule) = (if middle <= -1.0 { PI } else { cut }.min(ring.azimuth), shadowing.rule);
        let length = ring.azimuth - cut;
        let low = rule.integrate(0.0, 1.0, |t| {
            let cube = t * t * t;
            4.0 * cube * length * value(ring.azimuth - length * cube * t)
        });
        rule.integrate(0.0, cut, value) + low
    }

    /// v.h and mu_l of the facets of a ring by their azimuth, free of cancellation: mu_l = 2 a
    /// sin(theta) sin(theta_h) sin((phi_m + phi)/2) sin((phi_m - phi)/2), and cos(theta + 2 theta_h)
    /// more where the ring is lit all around.
    fn lights(&self, ring: &Ring) -> impl Fn(f64) -> (f64, f64) {
        let (fixed, swing) = (self.mu * ring.cosine, self.sine * ring.sine);
        let lowest = if ring.tangent.is_infinite() {
            (self.mu * (ring.cosine - ring.sine) * (ring.cosine + ring.sine)
                - 2.0 * self.sine * ring.sine * ring.cosine)
                .max(0.0)
        } else {
            0.0
        };
        let (azimuth, cosine) = (ring.azimuth, ring.cosine);
        move |phi: f64| {
            let both = ops::sin(0.5 * (azimuth + phi)) * ops::sin(0.5 * (azimuth - phi));
            (fixed + swing * ops::cos(phi), lowest + 4.0 * cosine * swing * both)
        }
    }
}

/// Cuts of [0, end] at the `falls` that lie in it, none longer than [`LONGEST`]; the range ends at
/// the last fall or at `end`.
fn cuts(falls: &[f64; 4], end: f64) -> Vec<f64> {
    let mut cuts = vec![0.0];
    for &fall in falls.iter().take_while(|fall| **fall < end).chain([&falls[3].min(end)]) {
        let from = cuts[cuts.len() - 1];
        let parts = ((fall - from) / LONGEST).ceil() as usize;
        cuts.extend((1..=parts).map(|i| from + (fall - from) * i as f64 / parts as f64));
    }
    cuts
}

fn integral(rule: &PanelRule, cuts: &[f64], f: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for cut in cuts.windows(2) {
        rule.each(cut[0], cut[1], |x, weight| sum += weight * f(x));
    }
    sum
}
