//! The ring of facets at one angle to the view.
//!
//! With the view at angle theta from the macro normal and e(psi) the unit vectors perpendicular to
//! it (psi = 0 towards the macro normal), a facet is h = cos(theta_d) v + sin(theta_d) e, so
//!   h_z = mu cos(theta_d) + sin(theta) sin(theta_d) cos(psi),
//!   mirrored  l_z =  mu cos(2 theta_d) + sin(theta) sin(2 theta_d) cos(psi),
//!   refracted l_z = -mu cos(delta) - sin(theta) sin(delta) cos(psi), delta the deviation towards -h.
//! D depends on h_z alone, with 1 - h_z = 2 sin^2((theta_d - theta)/2) + 2 sin(theta) sin(theta_d)
//! sin^2(psi/2) free of cancellation. tan(psi/4) = r sinh(v) puts the pole of D at v = i pi/2.

use multiversion::multiversion;

use super::facets::Facets;
use super::interface::Facet;
use crate::integrate::PanelRule;
use crate::optics::Smith;
use lobefit_math::lanes::{self, F8, LANES};
use lobefit_math::{ops, panels};

/// Longest panel in v.
const LONGEST: f64 = 2.0;

/// A view onto the lobe.
#[derive(Clone, Copy, Debug)]
pub(super) struct View<D> {
    pub smith: Smith,
    pub lobe: D,
    pub mu: f64,
    pub sine: f64,
    pub s_v: f64,
}

/// A direction whose height over the macro surface is `middle` + `swing` cos(psi).
#[derive(Clone, Copy, Debug)]
struct Height {
    middle: f64,
    swing: f64,
}

/// A ring of facets.
pub(super) struct Ring<'a, D> {
    view: &'a View<D>,
    /// 1 - h_z at psi = 0, and the coefficient of 2 sin^2(psi/2).
    low: f64,
    reach: f64,
    r: f64,
    /// End of v at the facets' own horizon.
    end: f64,
}

impl<'a, D: Facets> Ring<'a, D> {
    /// The ring at cos, sin of theta_d, with `half` = sin^2((theta_d - theta)/2).
    pub fn new(view: &'a View<D>, cosine: f64, sine: f64, half: f64) -> Ring<'a, D> {
        let reach = view.sine * sine;
        let low = 2.0 * half;
        // At psi, 1 - h_z = low + 2 reach sin^2(psi/2).
        let kappa = (view.lobe.width(low) / (2.0 * reach)).sqrt();
        let r = if kappa.is_finite() { kappa / (1.0 + (1.0 + kappa * kappa).sqrt()) } else { 1.0 };
        let facets = Height { middle: view.mu * cosine, swing: reach };
        let mut ring = Ring { view, low, reach, r, end: 0.0 };
        let deepest = (view.lobe.deepest(low) - low) / (2.0 * reach);
        ring.end = ring.v_at(facets.ends_below().min(deepest));
        ring
    }

    /// v of a half-azimuth given as sin^2(psi/2).
    fn v_at(&self, half: f64) -> f64 {
        // tan(psi/4) from sin(psi/2)
        let sine = half.min(1.0).sqrt();
        let tan = sine / (1.0 + ((1.0 - sine) * (1.0 + sine)).sqrt());
        ops::asinh(tan / self.r)
    }

    /// Mirrored light: [kept, lost] of G1(v) D over the ring, each divided by mu. `double` = cos,
    /// sin of 2 theta_d.
    pub fn mirrored(&self, double: [f64; 2], rule: &PanelRule) -> [f64; 2] {
        let height = Height { middle: self.view.mu * double[0], swing: self.view.sine * double[1] };
        self.split(height, rule)
    }

    /// Refracted light: the same, for the side that it must leave on.
    pub fn refracted(&self, facet: &Facet, rule: &PanelRule) -> [f64; 2] {
        let [cosine, sine] = facet.deviation;
        let height = Height { middle: self.view.mu * cosine, swing: self.view.sine * sine };
        self.split(height, rule)
    }

    /// Over the part of the ring where the height is positive: G2 D/mu and (G1 - G2) D/mu; over the
    /// rest G1 D/mu is lost.
    fn split(&self, height: Height, rule: &PanelRule) -> [f64; 2] {
        let end = self.end;
        if height.swing >= 0.0 {
            // Positive from psi = 0 on.
            let turn = self.v_at(height.ends_below()).min(end);
            let [kept, taken] = self.lit(height, 0.0, turn, rule);
            return [kept, taken + self.dark(turn, end, rule)];
        }
        let turn = self.v_at(height.begins_above()).min(end);
        let [kept, taken] = self.lit(height, turn, end, rule);
        [kept, taken + self.dark(0.0, turn, rule)]
    }

    fn lit(&self, height: Height, from: f64, to: f64, rule: &PanelRule) -> [f64; 2] {
        if to <= from {
            return [0.0; 2];
        }
        let scales = [from, to].map(|v| self.scale(height, v));
        let mut cuts = vec![from];
        panels::towards_both(&mut cuts, from, to, LONGEST, scales);
        lit(self, height, &cuts, rule)
    }

    fn dark(&self, from: f64, to: f64, rule: &PanelRule) -> f64 {
        if to <= from {
            return 0.0;
        }
        let mut cuts = vec![from];
        panels::towards_end(&mut cuts, from, to, LONGEST, 1.0);
        dark(self, &cuts, rule)
    }

    /// Scale in v on which the shadowing varies at an end where the light is near its horizon; 1
    /// elsewhere.
    fn scale(&self, height: Height, v: f64) -> f64 {
        let view = self.view;
        let tau = self.r * ops::sinh(v);
        let length2 = 1.0 + tau * tau;
        let half = 4.0 * tau * tau / (length2 * length2);
        let mu_l = height.at(half).abs().min(1.0);
        let s_l = view.lobe.area_at(mu_l);
        let layer = (view.mu * s_l / view.s_v).min(view.lobe.alpha()) + mu_l;
        // d height / d psi = -swing sin(psi), sin(psi) = 2 sin(psi/2) cos(psi/2); d psi = 4 d
        // tau/(1 + tau^2)
        let sin_psi = 2.0 * (half * (1.0 - half).max(0.0)).sqrt();
        let slope = height.swing.abs() * sin_psi * 4.0 * (self.r * self.r + tau * tau).sqrt() / length2;
        (layer / slope).clamp(1e-12, 1.0)
    }

    /// D times geometry factors of sin^2(psi/2), over both halves of the ring, in v.
    #[inline(always)]
    fn along<const N: usize>(&self, v: &F8, geometry: impl Fn(f64) -> [f64; N]) -> [F8; N] {
        let e = lanes::exp(v);
        let mut out = [[0.0; LANES]; N];
        for i in 0..LANES {
            let inverse = 1.0 / e[i];
            let tau = 0.5 * self.r * (e[i] - inverse);
            let slope = 0.5 * self.r * (e[i] + inverse);
            let length2 = 1.0 / (1.0 + tau * tau);
            let sine = 2.0 * tau * length2;
            let half = sine * sine;
            let depth = self.low + 2.0 * self.reach * half;
            let lobe = self.view.lobe.twice(depth);
            let factors = geometry(half);
            for k in 0..N {
                out[k][i] = lobe * factors[k] * 4.0 * slope * length2;
            }
        }
        out
    }
}

/// [kept, lost] where the light is above its horizon, compiled for the instructions that the processor has.
/// Every form does the same operations in the same order (nothing is contracted), so all give the same bits.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
fn lit<D: Facets>(ring: &Ring<D>, height: Height, cuts: &[f64], rule: &PanelRule) -> [f64; 2] {
    let view = ring.view;
    rule.panels_of_all(cuts, &|v| {
        ring.along(v, |half| {
            let above = height.at(half).max(0.0);
            let mu_l = above.min(1.0);
            let s_l = view.lobe.area_at(mu_l);
            let lift = view.lobe.lift_at(mu_l, s_l);
            [
                view.smith.shadowing_over_cosine(view.mu, view.s_v, above, s_l),
                view.smith.shadowed_over_cosine(view.mu, view.s_v, mu_l, s_l, lift),
            ]
        })
    })
}

/// What is lost where it is below, as [`lit`].
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
fn dark<D: Facets>(ring: &Ring<D>, cuts: &[f64], rule: &PanelRule) -> f64 {
    let masking = 2.0 / (ring.view.mu + ring.view.s_v);
    rule.panels(cuts, &|v| ring.along(v, |_| [masking])[0])
}

impl Height {
    /// At sin^2(psi/2).
    #[inline(always)]
    fn at(&self, half: f64) -> f64 {
        self.middle + self.swing - 2.0 * self.swing * half
    }

    /// sin^2(psi/2) up to which a height of positive swing is positive, in [0, 1].
    fn ends_below(&self) -> f64 {
        if self.swing <= 0.0 {
            return if self.middle > 0.0 { 1.0 } else { 0.0 };
        }
        (0.5 * (self.middle + self.swing) / self.swing).clamp(0.0, 1.0)
    }

    /// sin^2(psi/2) from which a height of negative swing is positive, in [0, 1].
    fn begins_above(&self) -> f64 {
        (0.5 * (self.middle + self.swing) / self.swing).clamp(0.0, 1.0)
    }
}
