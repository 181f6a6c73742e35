//! The reflection integral about a fixed view, over the polar angle of the light.
//!
//! With theta and theta_l the polar angles of view and light, put D = theta - theta_l and
//! S = theta + theta_l. For a light at azimuth psi from the plane of incidence (psi = 0 on the
//! mirror's side) the squared length of v + l is q(psi) = 4 cos^2(S/2) + 4 sin(theta) sin(theta_l)
//! sin^2(psi/2).
//!
//! The outer variable u, tan(-D/2) = a sinh(u), makes the peak at the mirror direction one unit
//! wide for every alpha: at psi = 0 the tangent of the half vector's angle is a |sinh(u)|. The
//! azimuth is integrated in closed form (by `Ring` where a weight sees v.h).

use crate::optics::Smith;
use crate::optics::distribution::{Distribution, Polar};
use lobefit_math::lanes::{self, F8, LANES};
use lobefit_math::{ops, panels};

/// A fixed view direction onto a lobe.
#[derive(Clone, Copy, Debug)]
pub(super) struct View<D> {
    pub smith: Smith,
    pub lobe: D,
    pub mu: f64,
    pub sine: f64,
    /// Projected area of all facets about the view direction.
    pub s_v: f64,
}

/// Eight lights with all that the integrands need.
pub(super) struct Lights {
    /// sin and cos of D/2.
    pub sin_d: F8,
    pub cos_d: F8,
    /// sin and cos of S/2.
    pub sin_s: F8,
    pub cos_s: F8,
    pub mu_l: F8,
    pub sin_l: F8,
    /// Projected area of all facets about the light direction.
    pub s_l: F8,
    /// |d mu_l / du|.
    pub jacobian: F8,
}

/// Longest panel in u of a distribution whose tail is a power: the integrand is singular at u = +-i
/// pi/2, so n Gauss nodes on a panel of length 2 leave (pi/2 + sqrt(pi^2/4 + 1))^-2n = 3.4^-2n:
/// 1e-17 for n = 16.
pub(super) const LONGEST: f64 = 2.0;

/// Longest panel in u of one whose tail is exp(-sinh^2 u): an entire function, which falls by e^-10
/// over such a panel at u = 2.
const LONGEST_OF_GAUSSIAN: f64 = 0.75;

/// Smallest panel at the horizon of a view at mu = 0, in units of alpha: what is left on it is
/// below the rounding, and the cosines of lights on it are still told from 0.
const FINEST: f64 = 1e-11;

/// Cosines below this are 0: panels graded down to them would be many, and E differs from its limit
/// by less.
const GRAZING: f64 = 1e-100;

impl<D: Distribution> View<D> {
    /// A view with alpha > 0 and mu in [0, 1]. A cosine below [`GRAZING`] is taken for 0, the limit
    /// that it cannot be told from.
    pub fn new(smith: Smith, lobe: D, mu: f64) -> View<D> {
        let mu = if mu < GRAZING { 0.0 } else { mu };
        let sine = ((1.0 - mu) * (1.0 + mu)).sqrt();
        View { smith, lobe, mu, sine, s_v: lobe.area_at(mu) }
    }

    /// Cuts of the outer variable from theta_l = 0 to the horizon.
    pub fn cuts(&self) -> Vec<f64> {
        let (a, mu) = (self.lobe.alpha(), self.mu);
        // At the horizon s_l has branch points at mu_l = +-i a, the correlated G2 a pole near
        // mu_l = -mu, and v.h, which Schlick's weight sees, a branch point near mu_l = -mu.
        self.cuts_down_to(if mu > 0.0 { a.min(mu) } else { a })
    }

    /// The cuts for a weight that sees v.h. At mu = 0 its branch point lies on the horizon.
    pub fn cuts_for_weight(&self) -> Vec<f64> {
        if self.mu > 0.0 { self.cuts() } else { self.cuts_down_to(FINEST * self.lobe.alpha()) }
    }

    /// Cuts that are graded to a cosine `scale` of the light.
    fn cuts_down_to(&self, scale: f64) -> Vec<f64> {
        let (a, mu) = (self.lobe.alpha(), self.mu);
        let from = -ops::asinh((self.sine / ((1.0 + mu) * a)).min(D::REACH));
        // tan((pi/2 - theta)/2) = mu / (1 + sin theta)
        let m = mu / (1.0 + self.sine);
        let to = ops::asinh((m / a).min(D::REACH));
        let slope = 2.0 * (a * a + m * m).sqrt() / (1.0 + m * m);
        let longest = if D::REACH.is_finite() { LONGEST_OF_GAUSSIAN } else { LONGEST };
        let mut cuts = vec![from];
        panels::towards_end(&mut cuts, from, to, longest, scale / slope);
        cuts
    }

    /// Cuts of the outer variable from the horizon to mu_l = -mu, where the half vector vanishes;
    /// of a distribution with a finite reach.
    pub fn cuts_below(&self) -> Vec<f64> {
        let a = self.lobe.alpha();
        let m = self.mu / (1.0 + self.sine);
        let from = ops::asinh((m / a).min(D::REACH));
        // tan(pi/2 - theta) = mu / sin theta
        let to = ops::asinh((self.mu / (self.sine * a)).min(D::REACH));
        if to <= from {
            return Vec::new();
        }
        let panels = ((to - from) / LONGEST_OF_GAUSSIAN).ceil().max(1.0);
        (0..=panels as usize).map(|i| from + (to - from) * i as f64 / panels).collect()
    }

    /// The lights at eight values of the outer variable, above the horizon.
    #[inline(always)]
    pub fn lights(&self, u: &F8) -> Lights {
        self.lights_above(u, 0.0)
    }

    /// The lights at eight values of the outer variable, no lower than a cosine; the areas of those
    /// below the horizon are meaningless.
    #[inline(always)]
    pub fn lights_above(&self, u: &F8, lowest: f64) -> Lights {
        let a = self.lobe.alpha();
        let a2 = a * a;
        let e = lanes::exp(u);
        let mut out = Lights::zero();
        for i in 0..LANES {
            let m = 0.5 * a * (e[i] - 1.0 / e[i]);
            let length2 = 1.0 + m * m;
            let cos_d = 1.0 / length2.sqrt();
            let sin_d = -m * cos_d;
            let sin_s = self.sine * cos_d - self.mu * sin_d;
            let cos_s = self.mu * cos_d + self.sine * sin_d;
            // cos(theta + 2 atan(m)): at grazing both terms are small, so their difference is good
            // to eps times them.
            let mu_l = ((self.mu * (1.0 - m) * (1.0 + m) - 2.0 * m * self.sine) / length2).max(lowest);
            let sin_l = sin_s * cos_d - cos_s * sin_d;
            out.sin_d[i] = sin_d;
            out.cos_d[i] = cos_d;
            out.sin_s[i] = sin_s;
            out.cos_s[i] = cos_s;
            out.mu_l[i] = mu_l;
            out.sin_l[i] = sin_l;
            out.s_l[i] = self.lobe.area(mu_l, sin_l);
            // theta_l = theta + 2 atan(m): d theta_l / du = 2 a cosh(u) / (1 + m^2)
            out.jacobian[i] = sin_l * 2.0 * (a2 + m * m).sqrt() / length2;
        }
        out
    }

    /// The lights at eight cosines in [-mu, 0], below the horizon. The outer variable is the cosine
    /// itself: K has its peak above the horizon and is smooth here.
    #[inline(always)]
    pub fn lights_below(&self, cosine: &F8) -> Lights {
        let (sin_v, cos_v) = (((1.0 - self.mu) * 0.5).sqrt(), ((1.0 + self.mu) * 0.5).sqrt());
        let mut out = Lights::zero();
        for i in 0..LANES {
            let (sin_l, cos_l) = (((1.0 - cosine[i]) * 0.5).sqrt(), ((1.0 + cosine[i]) * 0.5).sqrt());
            out.sin_s[i] = sin_v * cos_l + cos_v * sin_l;
            out.cos_d[i] = cos_v * cos_l + sin_v * sin_l;
            // mu_l - mu = 2 sin(S/2) sin(D/2), free of cancellation at grazing
            out.sin_d[i] = 0.5 * (cosine[i] - self.mu) / out.sin_s[i];
            // cos(S/2) cos(D/2) = (mu + mu_l)/2 without cancellation at mu_l = -mu
            out.cos_s[i] = 0.5 * (self.mu + cosine[i]) / out.cos_d[i];
            out.mu_l[i] = cosine[i];
            out.sin_l[i] = 2.0 * sin_l * cos_l;
            out.jacobian[i] = 1.0;
        }
        out
    }

    /// int_0^2pi D dpsi of the lights.
    #[inline(always)]
    pub fn azimuth_integral(&self, at: &Lights) -> F8 {
        std::array::from_fn(|i| self.lobe.azimuth_integral(&at.polar(i)))
    }
}

impl Lights {
    /// One of the polar angles.
    #[inline(always)]
    pub fn polar(&self, i: usize) -> Polar {
        Polar { sin_d: self.sin_d[i], cos_d: self.cos_d[i], sin_s: self.sin_s[i], cos_s: self.cos_s[i] }
    }

    fn zero() -> Lights {
        let zero = [0.0; LANES];
        Lights {
            sin_d: zero,
            cos_d: zero,
            sin_s: zero,
            cos_s: zero,
            mu_l: zero,
            sin_l: zero,
            s_l: zero,
            jacobian: zero,
        }
    }
}
