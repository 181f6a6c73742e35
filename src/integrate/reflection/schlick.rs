//! The reflection integral weighted with a function of v.h, over polar angle and azimuth: B for Schlick's (1 - v.h)^5.

use crate::data::Smith;
use crate::math::lanes::{self, F8, LANES};
use crate::math::ops;
use crate::optics::{fresnel, ggx};

use super::effort::Effort;
use super::geometry::View;

/// B(alpha, mu); alpha > 0, mu in [0, 1].
pub(super) fn bias(smith: Smith, alpha: f64, mu: f64, effort: &Effort) -> f64 {
    reflected(smith, alpha, mu, effort, &fresnel::schlick_weight)
}

/// The albedo of the lobe with reflectance `fresnel`(1 - v.h) by one rule, without an error bound; alpha > 0, mu in [0, 1]. `fresnel` is
/// smooth over [0, 1].
pub fn reflected(
    smith: Smith,
    alpha: f64,
    mu: f64,
    effort: &Effort,
    fresnel: &(impl Fn(f64) -> f64 + Sync),
) -> f64 {
    let view = View::new(smith, alpha, mu);
    effort.outer.panels(&view.cuts(), &|u| integrand(&view, u, effort, fresnel))
}

fn integrand(view: &View, u: &F8, effort: &Effort, fresnel: &impl Fn(f64) -> f64) -> F8 {
    let at = view.lights(u);
    let a2 = view.alpha * view.alpha;
    let mut out = [0.0; LANES];
    for i in 0..LANES {
        let geometry = ggx::shadowing_over_cosine(view.smith, view.mu, view.s_v, at.mu_l[i], at.s_l[i]);
        let ring = Ring {
            near: at.cos_s[i] * at.cos_s[i],
            peak: at.sin_d[i] * at.sin_d[i] + a2 * at.cos_d[i] * at.cos_d[i],
            far: at.sin_s[i] * at.sin_s[i],
            swing: view.sine * at.sin_l[i],
        };
        out[i] = 0.25 * geometry * at.jacobian[i] * a2 * ring.integral(effort, fresnel);
    }
    out
}

/// One polar angle of the light, over its azimuth psi. With t = `swing` sin^2(psi/2), |v + l|^2/4 = `near` + t and
/// its part off the peak is `near peak` + t; 1 - (v.h)^2 = `far` - t.
struct Ring {
    near: f64,
    peak: f64,
    far: f64,
    swing: f64,
}

impl Ring {
    /// int_0^2pi (D pi/a^2) F(1 - v.h) dpsi / pi, by tan(psi/4) = r sinh(v): r puts the pole of D at v = i pi/2 for every
    /// alpha.
    fn integral(&self, effort: &Effort, fresnel: &impl Fn(f64) -> f64) -> f64 {
        // D has its pole at sin(psi/2) = i kappa; 2 r/(1 - r^2) = kappa. Without swing the ring is even: r = 1.
        let square = self.near * self.peak;
        let r = square.sqrt() / (self.swing.sqrt() + (self.swing + square).sqrt());
        let r = r.min(1.0);
        let end = ops::asinh(1.0 / r);
        let sum = effort.inner(end).panel(0.0, end, &|v| self.at(v, r, fresnel));
        2.0 * sum / std::f64::consts::PI
    }

    #[inline(always)]
    fn at(&self, v: &F8, r: f64, fresnel: &impl Fn(f64) -> f64) -> F8 {
        let e = lanes::exp(v);
        let mut out = [0.0; LANES];
        for i in 0..LANES {
            let inverse = 1.0 / e[i];
            let tau = 0.5 * r * (e[i] - inverse);
            let slope = 0.5 * r * (e[i] + inverse);
            let length2 = 1.0 / (1.0 + tau * tau);
            let sine = 2.0 * tau * length2;
            let t = self.swing * sine * sine;
            let half2 = self.near + t;
            let ratio = half2 / (self.near * self.peak + t);
            let complement = (self.far - t) / (1.0 + half2.sqrt());
            out[i] = ratio * ratio * fresnel(complement) * 4.0 * slope * length2;
        }
        out
    }
}
