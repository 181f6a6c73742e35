//! The reflection integral weighted with a function of v.h, over polar angle and azimuth: B for
//! Schlick's (1 - v.h)^5.

use multiversion::multiversion;

use crate::integrate::estimate::{Integrand, PanelRule};
use crate::optics::Smith;
use crate::optics::distribution::{Distribution, Ggx, Polar};
use crate::optics::fresnel;
use lobefit_math::lanes::{self, F8, LANES};
use lobefit_math::ops;

use super::effort::Effort;
use super::geometry::{Lights, View};

/// B of a view, compiled for the instructions that the processor has. Every form does the same
/// operations in the same order (nothing is contracted), so all give the bits that [`reflected`]
/// gives.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
pub(super) fn bias<D: Distribution>(view: &View<D>, effort: &Effort) -> f64 {
    effort.outer.panels(&view.cuts_for_weight(), &|u| integrand(view, u, effort, &fresnel::schlick_weight))
}

/// The albedo of the GGX lobe with reflectance `fresnel`(1 - v.h) by one rule, without an error
/// bound; alpha > 0, mu in [0, 1]. `fresnel` is smooth over [0, 1].
pub fn reflected(
    smith: Smith,
    alpha: f64,
    mu: f64,
    effort: &Effort,
    fresnel: &(impl Fn(f64) -> f64 + Sync),
) -> f64 {
    let view = View::new(smith, Ggx(alpha), mu);
    effort.outer.panels(&view.cuts_for_weight(), &|u| integrand(&view, u, effort, fresnel))
}

#[inline(always)]
fn integrand<D: Distribution>(view: &View<D>, u: &F8, effort: &Effort, fresnel: &impl Fn(f64) -> f64) -> F8 {
    let at = view.lights(u);
    let a2 = view.lobe.alpha() * view.lobe.alpha();
    let mut out = [0.0; LANES];
    for i in 0..LANES {
        let geometry = view.smith.shadowing_over_cosine(view.mu, view.s_v, at.mu_l[i], at.s_l[i]);
        let ring = Ring::new(view, &at, i);
        let integral = ring.integral(&|end| effort.azimuth::<D>(end), fresnel);
        out[i] = 0.25 * geometry * at.jacobian[i] * a2 * integral;
    }
    out
}

/// One polar angle of the light, over its azimuth psi. With t = `swing`
/// sin^2(psi/2), |v + l|^2/4 = cos^2(S/2) + t and 1 - (v.h)^2 = sin^2(S/2) - t.
pub(super) struct Ring<D> {
    lobe: D,
    polar: Polar,
    swing: f64,
}

/// Where the azimuth integral of a distribution with tail exp(-sinh^2 v) ends at the latest. On a
/// ring of any r that reaches so far, t is there 68 times the fall at least.
pub(super) const GAUSSIAN_END: f64 = 3.5;

impl<D: Distribution> Ring<D> {
    #[inline(always)]
    pub fn new(view: &View<D>, at: &Lights, i: usize) -> Ring<D> {
        Ring { lobe: view.lobe, polar: at.polar(i), swing: view.sine * at.sin_l[i] }
    }

    /// int_0^2pi (D pi/a^2) F(1 - v.h) dpsi / pi, by tan(psi/4) = r sinh(v): r makes the scale on
    /// which D falls off one unit of v for every alpha, for GGX by its pole at v = i pi/2. `rule`
    /// has the rule of an interval [0, end].
    #[inline(always)]
    pub fn integral<'r>(&self, rule: &impl Fn(f64) -> &'r PanelRule, fresnel: &impl Fn(f64) -> f64) -> f64 {
        // D falls off at sin(psi/2) = kappa; 2 r/(1 - r^2) = kappa. Without swing the ring is even:
        // r = 1.
        let square = self.lobe.fall(&self.polar);
        let r = square.sqrt() / (self.swing.sqrt() + (self.swing + square).sqrt());
        let r = r.min(1.0);
        let end = ops::asinh(1.0 / r);
        let end = if D::REACH.is_finite() { end.min(GAUSSIAN_END) } else { end };
        let sum = rule(end).panel_of(0.0, end, &Azimuth { ring: self, r, fresnel });
        2.0 * sum / std::f64::consts::PI
    }
}

/// What is integrated over the azimuth.
struct Azimuth<'a, D, F> {
    ring: &'a Ring<D>,
    r: f64,
    fresnel: &'a F,
}

impl<D: Distribution, F: Fn(f64) -> f64> Integrand for Azimuth<'_, D, F> {
    #[inline(always)]
    fn at(&self, v: &F8) -> F8 {
        let Azimuth { ring, r, fresnel } = *self;
        let polar = &ring.polar;
        let (near, far) = (polar.cos_s * polar.cos_s, polar.sin_s * polar.sin_s);
        let e = lanes::exp(v);
        let mut out = [0.0; LANES];
        for i in 0..LANES {
            let inverse = 1.0 / e[i];
            let tau = 0.5 * r * (e[i] - inverse);
            let slope = 0.5 * r * (e[i] + inverse);
            let length2 = 1.0 / (1.0 + tau * tau);
            let sine = 2.0 * tau * length2;
            let t = ring.swing * sine * sine;
            let complement = (far - t) / (1.0 + (near + t).sqrt());
            out[i] = ring.lobe.density_of_half(polar, t) * fresnel(complement) * 4.0 * slope * length2;
        }
        out
    }
}
