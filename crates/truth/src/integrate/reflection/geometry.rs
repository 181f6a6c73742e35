//! The reflection integral about a fixed view, over the polar angle of the light.
//!
//! With theta and theta_l the polar angles of view and light, put D = theta - theta_l and S = theta + theta_l. For a light
//! at azimuth psi from the plane of incidence (psi = 0 on the mirror's side) the squared length of v + l is
//! q(psi) = 4 cos^2(S/2) + 4 sin(theta) sin(theta_l) sin^2(psi/2), and with h = (v + l)/|v + l|
//!
//!   D(h) = (a^2/pi) (q/(q - k))^2,   k = (1 - a^2)(mu + mu_l)^2,
//!   q - k at psi = 0 is 4 cos^2(S/2) P,   P = sin^2(D/2) + a^2 cos^2(D/2),
//!   q - k at psi = pi is 4 cos^2(D/2) Q,  Q = sin^2(S/2) + a^2 cos^2(S/2).
//!
//! D is rational in cos(psi), so its azimuth integral is elementary and free of cancellation (numbered (1) below).
//! The outer variable u, tan(-D/2) = a sinh(u), makes the peak at the mirror direction one unit wide for every alpha.

use crate::optics::Smith;
use crate::optics::ggx;
use lobefit_math::lanes::{self, F8, LANES};
use lobefit_math::{ops, panels};

/// A fixed view direction onto a lobe.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub smith: Smith,
    pub alpha: f64,
    pub mu: f64,
    pub sine: f64,
    /// Stretched length of the view direction.
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
    /// Stretched length of the light direction.
    pub s_l: F8,
    /// |d mu_l / du|.
    pub jacobian: F8,
}

/// Longest panel in u: the integrand is singular at u = +-i pi/2, so n Gauss nodes on a panel of length 2 leave
/// (pi/2 + sqrt(pi^2/4 + 1))^-2n = 3.4^-2n: 1e-17 for n = 16.
pub(super) const LONGEST: f64 = 2.0;

/// Cosines below this are 0: panels graded down to them would be many, and E differs from its limit by less.
const GRAZING: f64 = 1e-100;

impl View {
    /// A view with alpha > 0 and mu in [0, 1]. A cosine below [`GRAZING`] is taken for 0, the limit that it cannot be told from.
    pub fn new(smith: Smith, alpha: f64, mu: f64) -> View {
        let mu = if mu < GRAZING { 0.0 } else { mu };
        let sine = ((1.0 - mu) * (1.0 + mu)).sqrt();
        View { smith, alpha, mu, sine, s_v: ggx::stretched_length(alpha, mu) }
    }

    /// Cuts of the outer variable from theta_l = 0 to the horizon.
    pub fn cuts(&self) -> Vec<f64> {
        let (a, mu) = (self.alpha, self.mu);
        let from = -ops::asinh(self.sine / ((1.0 + mu) * a));
        // tan((pi/2 - theta)/2) = mu / (1 + sin theta)
        let m = mu / (1.0 + self.sine);
        let to = ops::asinh(m / a);
        // At the horizon s_l has branch points at mu_l = +-i a, the correlated G2 a pole near mu_l = -mu, and v.h, which
        // Schlick's weight sees, a branch point near mu_l = -mu.
        let scale = if mu > 0.0 { a.min(mu) } else { a };
        let slope = 2.0 * (a * a + m * m).sqrt() / (1.0 + m * m);
        let mut cuts = vec![from];
        panels::towards_end(&mut cuts, from, to, LONGEST, scale / slope);
        cuts
    }

    /// The lights at eight values of the outer variable.
    #[inline(always)]
    pub fn lights(&self, u: &F8) -> Lights {
        let (a, a2) = (self.alpha, self.alpha * self.alpha);
        let e = lanes::exp(u);
        let mut out = Lights::zero();
        for i in 0..LANES {
            let m = 0.5 * a * (e[i] - 1.0 / e[i]);
            let length2 = 1.0 + m * m;
            let cos_d = 1.0 / length2.sqrt();
            let sin_d = -m * cos_d;
            let sin_s = self.sine * cos_d - self.mu * sin_d;
            let cos_s = self.mu * cos_d + self.sine * sin_d;
            // cos(theta + 2 atan(m)): at grazing both terms are small, so their difference is good to eps times them.
            let mu_l = ((self.mu * (1.0 - m) * (1.0 + m) - 2.0 * m * self.sine) / length2).max(0.0);
            let sin_l = sin_s * cos_d - cos_s * sin_d;
            out.sin_d[i] = sin_d;
            out.cos_d[i] = cos_d;
            out.sin_s[i] = sin_s;
            out.cos_s[i] = cos_s;
            out.mu_l[i] = mu_l;
            out.sin_l[i] = sin_l;
            out.s_l[i] = (mu_l * mu_l + a2 * sin_l * sin_l).sqrt();
            // theta_l = theta + 2 atan(m): d theta_l / du = 2 a cosh(u) / (1 + m^2)
            out.jacobian[i] = sin_l * 2.0 * (a2 + m * m).sqrt() / length2;
        }
        out
    }

    /// The lights at eight cosines in [-mu, 0], below the horizon. The outer variable is the cosine itself: K has its
    /// peak above the horizon and is smooth here.
    #[inline(always)]
    pub fn lights_below(&self, cosine: &F8) -> Lights {
        let a2 = self.alpha * self.alpha;
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
            out.s_l[i] = (cosine[i] * cosine[i] + a2 * out.sin_l[i] * out.sin_l[i]).sqrt();
            out.jacobian[i] = 1.0;
        }
        out
    }

    /// K = int_0^2pi D dpsi (1):
    /// 2 a^2 [1 + 2 (1-a^2) C / sqrt(PQ) + (1-a^2)^2 C (cos^2(S/2) P + cos^2(D/2) Q) / (2 (PQ)^(3/2))],
    /// C = cos(D/2) cos(S/2). For a <= 1 every term is positive.
    #[inline(always)]
    pub fn azimuth_integral(&self, at: &Lights) -> F8 {
        let a2 = self.alpha * self.alpha;
        let rest = (1.0 - self.alpha) * (1.0 + self.alpha);
        let mut out = [0.0; LANES];
        for i in 0..LANES {
            let (cos_d2, cos_s2) = (at.cos_d[i] * at.cos_d[i], at.cos_s[i] * at.cos_s[i]);
            let p = at.sin_d[i] * at.sin_d[i] + a2 * cos_d2;
            let q = at.sin_s[i] * at.sin_s[i] + a2 * cos_s2;
            let c = rest * at.cos_d[i] * at.cos_s[i];
            let inverse = 1.0 / (p * q);
            let root = inverse.sqrt();
            let tail = 0.5 * rest * (cos_s2 * p + cos_d2 * q) * inverse;
            out[i] = 2.0 * a2 * (1.0 + c * root * (2.0 + tail));
        }
        out
    }
}

impl Lights {
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
