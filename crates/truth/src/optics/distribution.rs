//! Distributions of microfacet normals as the integrators see them.
//!
//! What Smith's theory needs of a distribution is one function of a direction, the projected area
//! of all facets about it, front and back: s(omega) = mu (1 + 2 Lambda). It is finite at grazing
//! view, where Lambda is not. With it G1 = 2 mu/(mu + s) and both forms of G2 are the same
//! functions for every distribution ([`Smith`](super::Smith)).

use super::ggx::{self, Vec3};

/// The lights at one polar angle theta_l about a view at theta, by half of S = theta + theta_l and
/// of D = theta - theta_l. At an azimuth psi from the mirror's side, t = sin(theta) sin(theta_l)
/// sin^2(psi/2), and |v + l|^2/4 = cos^2(S/2) + t.
#[derive(Clone, Copy, Debug)]
pub struct Polar {
    /// sin(D/2).
    pub sin_d: f64,
    /// cos(D/2).
    pub cos_d: f64,
    /// sin(S/2).
    pub sin_s: f64,
    /// cos(S/2).
    pub cos_s: f64,
}

/// An isotropic distribution of microfacet normals of some width alpha above 0.
pub trait Distribution: Copy + Sync {
    /// The width.
    fn alpha(self) -> f64;

    /// D of a unit normal on the side of the surface; the integral of D cos over the hemisphere
    /// is 1.
    fn density(self, normal: Vec3) -> f64;

    /// The largest tan(theta_h)/alpha at which D is not 0 in f64: infinite of a distribution whose
    /// tail is a power.
    const REACH: f64;

    /// Whether the shadowing follows from D by Smith's theory, so that the weak white furnace holds
    /// and visible normals are drawn by the same masking.
    const MATCHED: bool = true;

    /// pi D/alpha^2 of the half vector at t (see [`Polar`]), without cancellation at the peak.
    fn density_of_half(self, polar: &Polar, t: f64) -> f64;

    /// The t by which D falls off from its value at t = 0.
    fn fall(self, polar: &Polar) -> f64;

    /// The integral of D over the azimuth of the light.
    fn azimuth_integral(self, polar: &Polar) -> f64;

    /// The projected area s = mu (1 + 2 Lambda) of all facets about a direction with this cosine >=
    /// 0 and sine.
    fn area(self, cosine: f64, sine: f64) -> f64;

    /// The same of a cosine alone.
    #[inline(always)]
    fn area_at(self, cosine: f64) -> f64 {
        self.area(cosine, ((1.0 - cosine) * (1.0 + cosine)).sqrt())
    }

    /// s - mu = 2 mu Lambda, without cancellation; `area` is s.
    fn lift(self, cosine: f64, sine: f64, area: f64) -> f64;

    /// The same of a cosine alone.
    #[inline(always)]
    fn lift_at(self, cosine: f64, area: f64) -> f64 {
        self.lift(cosine, ((1.0 - cosine) * (1.0 + cosine)).sqrt(), area)
    }

    /// Smith's Lambda of a cosine in (0, 1].
    fn lambda(self, cosine: f64) -> f64 {
        let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
        self.lift(cosine, sine, self.area(cosine, sine)) / (2.0 * cosine)
    }

    /// Smith's Lambda of a direction on either side.
    fn lambda_towards(self, direction: Vec3) -> f64 {
        self.lambda(direction[2].abs())
    }

    /// A normal visible from `view` (of unit length, above the surface), drawn by two numbers in
    /// [0, 1).
    fn visible_normal(self, view: Vec3, u: f64, v: f64) -> Vec3;
}

/// GGX, or Trowbridge-Reitz (1975): [`ggx`].
#[derive(Clone, Copy, Debug)]
pub struct Ggx(pub f64);

impl Ggx {
    /// sin^2(D/2) + alpha^2 cos^2(D/2).
    #[inline(always)]
    fn peak(self, polar: &Polar) -> f64 {
        polar.sin_d * polar.sin_d + self.0 * self.0 * polar.cos_d * polar.cos_d
    }
}

impl Distribution for Ggx {
    #[inline(always)]
    fn alpha(self) -> f64 {
        self.0
    }

    fn density(self, normal: Vec3) -> f64 {
        ggx::distribution(self.0, normal)
    }

    const REACH: f64 = f64::INFINITY;

    /// With q = |v + l|^2, D = (alpha^2/pi) (q/(q - k))^2, k = (1 - alpha^2)(mu + mu_l)^2:
    /// q - k = 4 (cos^2(S/2) P + t).
    #[inline(always)]
    fn density_of_half(self, polar: &Polar, t: f64) -> f64 {
        let near = polar.cos_s * polar.cos_s;
        let ratio = (near + t) / (near * self.peak(polar) + t);
        ratio * ratio
    }

    #[inline(always)]
    fn fall(self, polar: &Polar) -> f64 {
        polar.cos_s * polar.cos_s * self.peak(polar)
    }

    /// With q - k at psi = 0 as 4 cos^2(S/2) P, P = sin^2(D/2) + a^2 cos^2(D/2), and at psi = pi as
    /// 4 cos^2(D/2) Q, Q = sin^2(S/2) + a^2 cos^2(S/2), the integral is 2 a^2 [1 + 2 (1-a^2)
    /// C / sqrt(PQ) + (1-a^2)^2 C (cos^2(S/2) P + cos^2(D/2) Q) / (2 (PQ)^(3/2))], C = cos(D/2)
    /// cos(S/2). For a <= 1 every term is positive.
    #[inline(always)]
    fn azimuth_integral(self, polar: &Polar) -> f64 {
        let a2 = self.0 * self.0;
        let rest = (1.0 - self.0) * (1.0 + self.0);
        let (cos_d2, cos_s2) = (polar.cos_d * polar.cos_d, polar.cos_s * polar.cos_s);
        let p = polar.sin_d * polar.sin_d + a2 * cos_d2;
        let q = polar.sin_s * polar.sin_s + a2 * cos_s2;
        let c = rest * polar.cos_d * polar.cos_s;
        let inverse = 1.0 / (p * q);
        let root = inverse.sqrt();
        let tail = 0.5 * rest * (cos_s2 * p + cos_d2 * q) * inverse;
        2.0 * a2 * (1.0 + c * root * (2.0 + tail))
    }

    #[inline(always)]
    fn area(self, cosine: f64, sine: f64) -> f64 {
        (cosine * cosine + self.0 * self.0 * sine * sine).sqrt()
    }

    #[inline(always)]
    fn area_at(self, cosine: f64) -> f64 {
        ggx::stretched_length(self.0, cosine)
    }

    /// s^2 - mu^2 = alpha^2 sin^2.
    #[inline(always)]
    fn lift(self, cosine: f64, sine: f64, area: f64) -> f64 {
        self.0 * self.0 * sine * sine / (area + cosine)
    }

    #[inline(always)]
    fn lift_at(self, cosine: f64, area: f64) -> f64 {
        self.0 * self.0 * ((1.0 - cosine) * (1.0 + cosine)) / (area + cosine)
    }

    #[inline(always)]
    fn lambda(self, cosine: f64) -> f64 {
        ggx::lambda(self.0, cosine)
    }

    fn lambda_towards(self, direction: Vec3) -> f64 {
        ggx::lambda_towards([self.0; 2], direction)
    }

    fn visible_normal(self, view: Vec3, u: f64, v: f64) -> Vec3 {
        ggx::visible_normal([self.0; 2], view, u, v)
    }
}
