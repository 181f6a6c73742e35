//! What a kernel needs of the lobe seen from one direction, and the azimuth map that its two inner
//! integrals share.

use super::tabled::Tabled;
use crate::optics::Smith;
use lobefit_math::lanes::{self, F8, LANES};

/// A lobe and its view.
#[derive(Clone, Copy, Debug)]
pub struct Lobe<D> {
    pub facets: D,
    pub alpha: f64,
    /// alpha^2 and 1 - alpha^2.
    pub a2: f64,
    pub rest: f64,
    pub mu: f64,
    pub sine: f64,
    /// G2/mu = factor mu_l/(own mu_l + other s_l), s_l =
    /// [`Distribution::area`](crate::optics::distribution::Distribution::area): both Smith forms.
    pub own: f64,
    pub other: f64,
    pub factor: f64,
}

impl<D: Tabled> Lobe<D> {
    pub fn new(smith: Smith, facets: D, mu: f64) -> Lobe<D> {
        let (alpha, s_v) = (facets.alpha(), facets.area_at(mu));
        let (own, other, factor) = match smith {
            Smith::Correlated => (s_v, mu, 2.0),
            Smith::Separable => (1.0, 1.0, 4.0 / (mu + s_v)),
        };
        Lobe {
            facets,
            alpha,
            a2: alpha * alpha,
            rest: (1.0 - alpha) * (1.0 + alpha),
            mu,
            sine: ((1.0 - mu) * (1.0 + mu)).sqrt(),
            own,
            other,
            factor,
        }
    }

    /// The largest u at which anything is left.
    pub fn span(&self) -> f64 {
        let tan = D::SPAN * self.alpha;
        if tan.is_finite() { self.u(tan / (1.0 + (1.0 + tan * tan).sqrt())) } else { f64::INFINITY }
    }

    /// tan(w/2) of a facet angle as the sweep's variable u: tan(w/2) = (alpha/2) sinh(u) makes the
    /// peak one unit wide.
    pub fn u(&self, tangent: f64) -> f64 {
        let x = (2.0 / self.alpha) * tangent.abs();
        let u = lanes::ln(&[x + (x * x + 1.0).sqrt(); LANES])[0];
        if tangent < 0.0 { -u } else { u }
    }
}

/// Facet angles of eight values of u: cos(w), sin(w), tan(w/2)^2 and dw/du.
#[derive(Clone, Copy, Debug)]
pub(super) struct Angles {
    pub cosine: F8,
    pub sine: F8,
    pub square: F8,
    pub slope: F8,
}

impl Angles {
    #[inline(always)]
    pub fn new(alpha: f64, u: &F8) -> Angles {
        let e = lanes::exp(u);
        let mut angles =
            Angles { cosine: [0.0; LANES], sine: [0.0; LANES], square: [0.0; LANES], slope: [0.0; LANES] };
        for i in 0..LANES {
            let inverse = 1.0 / e[i];
            let m = 0.25 * alpha * (e[i] - inverse);
            let length2 = 1.0 / (1.0 + m * m);
            angles.cosine[i] = (1.0 - m) * (1.0 + m) * length2;
            angles.sine[i] = 2.0 * m * length2;
            angles.square[i] = m * m;
            angles.slope[i] = 0.5 * alpha * (e[i] + inverse) * length2;
        }
        angles
    }
}

/// The azimuth as tan(phi/4) = `scale` S(`top` t), t in [0, 1], S(x) = C(C(x)) with C(x) = 3 x + 4
/// x^3. As sinh(3 v) = C(sinh v), S(sinh v) = sinh(9 v): close to the map tan(phi/4) = r sinh(v)
/// that moves a peak of half width r one unit away from the axis, but without an exponential for
/// every node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Azimuth {
    pub scale: F8,
    pub top: F8,
    /// Largest v of the eight.
    pub reach: f64,
}

impl Azimuth {
    /// From sin^2(phi/2) at the end of the range and of the peak (its analytic continuation, as a
    /// positive number).
    #[inline(always)]
    pub fn new(end: &F8, peak: &F8) -> Azimuth {
        let (mut last, mut ratio) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            let sine = end[i].sqrt();
            last[i] = sine / (1.0 + ((1.0 - sine) * (1.0 + sine)).sqrt());
            // The peak's own tan(phi/4) is kappa/(1 + sqrt(1 + kappa^2)), kappa^2 = peak.
            let q = last[i] * (1.0 + (1.0 + peak[i]).sqrt()) / peak[i].sqrt();
            ratio[i] = q + (q * q + 1.0).sqrt();
        }
        let mut v = lanes::ln(&ratio);
        let mut reach = 0.0;
        for i in 0..LANES {
            reach = if v[i] > reach { v[i] } else { reach };
        }
        for i in 0..LANES {
            v[i] *= 1.0 / 9.0;
        }
        let e = lanes::exp(&v);
        let mut azimuth = Azimuth { scale: [0.0; LANES], top: [0.0; LANES], reach };
        for i in 0..LANES {
            let x = 0.5 * (e[i] - 1.0 / e[i]);
            let x = if x > 1e-9 { x } else { 1e-9 };
            let p = x * (3.0 + 4.0 * x * x);
            azimuth.scale[i] = last[i] / (p * (3.0 + 4.0 * p * p));
            azimuth.top[i] = x;
        }
        azimuth
    }

    /// tan(phi/4)/scale and its derivative by x at x = top t.
    #[inline(always)]
    pub fn at(x: f64) -> [f64; 2] {
        let x2 = x * x;
        let p = x * (3.0 + 4.0 * x2);
        let p2 = p * p;
        [p * (3.0 + 4.0 * p2), (3.0 + 12.0 * x2) * (3.0 + 12.0 * p2)]
    }
}
