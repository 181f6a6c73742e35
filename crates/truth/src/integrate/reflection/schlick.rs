//! The reflection integral weighted with a function of v.h, over polar angle and azimuth: B for Schlick's (1 - v.h)^5.

use multiversion::multiversion;

use crate::integrate::estimate::Integrand;
use crate::optics::Smith;
use crate::optics::{fresnel, ggx};
use lobefit_math::lanes::{self, F8, LANES};
use lobefit_math::ops;

use super::effort::Effort;
use super::geometry::View;

/// B(alpha, mu); alpha > 0, mu in [0, 1].
pub(super) fn bias(smith: Smith, alpha: f64, mu: f64, effort: &Effort) -> f64 {
    schlick(&View::new(smith, alpha, mu), effort)
}

/// [`bias`], compiled for the instructions that the processor has. Every form does the same operations in the same order
/// (nothing is contracted), so all give the bits that [`reflected`] gives.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
fn schlick(view: &View, effort: &Effort) -> f64 {
    effort.outer.panels(&view.cuts(), &|u| integrand(view, u, effort, &fresnel::schlick_weight))
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

#[inline(always)]
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
    #[inline(always)]
    fn integral(&self, effort: &Effort, fresnel: &impl Fn(f64) -> f64) -> f64 {
        // D has its pole at sin(psi/2) = i kappa; 2 r/(1 - r^2) = kappa. Without swing the ring is even: r = 1.
        let square = self.near * self.peak;
        let r = square.sqrt() / (self.swing.sqrt() + (self.swing + square).sqrt());
        let r = r.min(1.0);
        let end = ops::asinh(1.0 / r);
        let sum = effort.inner(end).panel_of(0.0, end, &Azimuth { ring: self, r, fresnel });
        2.0 * sum / std::f64::consts::PI
    }
}

/// What is integrated over the azimuth.
struct Azimuth<'a, F> {
    ring: &'a Ring,
    r: f64,
    fresnel: &'a F,
}

impl<F: Fn(f64) -> f64> Integrand for Azimuth<'_, F> {
    #[inline(always)]
    fn at(&self, v: &F8) -> F8 {
        let Azimuth { ring, r, fresnel } = *self;
        let e = lanes::exp(v);
        let mut out = [0.0; LANES];
        for i in 0..LANES {
            let inverse = 1.0 / e[i];
            let tau = 0.5 * r * (e[i] - inverse);
            let slope = 0.5 * r * (e[i] + inverse);
            let length2 = 1.0 / (1.0 + tau * tau);
            let sine = 2.0 * tau * length2;
            let t = ring.swing * sine * sine;
            let half2 = ring.near + t;
            let ratio = half2 / (ring.near * ring.peak + t);
            let complement = (ring.far - t) / (1.0 + half2.sqrt());
            out[i] = ratio * ratio * fresnel(complement) * 4.0 * slope * length2;
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_form_for_this_processor_gives_the_bits_of_the_plain_one() {
        let effort = &Effort::ladder()[0];
        for smith in [Smith::Correlated, Smith::Separable] {
            for (alpha, mu) in [(1e-4, 1.0), (0.01, 1e-3), (0.2, 0.3), (1.0, 0.9)] {
                let plain = reflected(smith, alpha, mu, effort, &fresnel::schlick_weight);
                assert_eq!(bias(smith, alpha, mu, effort).to_bits(), plain.to_bits(), "{alpha} {mu}");
            }
        }
    }
}
