//! One ray of facets from the macro normal at a fixed azimuth: facet angle t, tan(t/2) = (g/2)
//! sinh(v), g the effective alpha along the ray. In v the distribution is one unit wide, with its
//! poles at +-i pi/2.

use multiversion::multiversion;

use super::view::View;
use crate::integrate::PanelRule;
use lobefit_math::lanes::{self, F8, LANES};
use lobefit_math::{ops, panels};

/// Longest panel in v, as for the isotropic lobe.
pub(super) const LONGEST: f64 = 2.0;

/// A ray of facets.
pub(super) struct Ray<'a> {
    pub(super) view: &'a View,
    /// cos and sin of the facets' azimuth.
    pub(super) azimuth: [f64; 2],
    /// Effective alpha along the ray.
    pub(super) g: f64,
    /// Cosine between the azimuths of facets and view.
    pub(super) cosine: f64,
}

impl<'a> Ray<'a> {
    /// The ray whose stretched azimuth is (cos, sin): its direction is (alpha_x cos, alpha_y
    /// sin)/g.
    pub fn new(view: &'a View, stretched: [f64; 2]) -> Ray<'a> {
        let (x, y) = (view.alpha[0] * stretched[0], view.alpha[1] * stretched[1]);
        let g = (x * x + y * y).sqrt();
        let azimuth = [x / g, y / g];
        let cosine = azimuth[0] * view.azimuth[0] + azimuth[1] * view.azimuth[1];
        Ray { view, azimuth, g, cosine }
    }

    /// E and loss of the ray, each times g^2: int sin(t) (v.h) G/mu / (cos^2 t + sin^2 t/g^2)^2
    /// dt / g^2.
    pub fn integrate(&self, rule: &PanelRule) -> [f64; 2] {
        let lean = self.view.sine * self.cosine;
        let q = (self.view.mu * self.view.mu + lean * lean).sqrt();
        let [horizon, end] = self.ends(lean, q);
        let to = ops::asinh(2.0 * horizon / self.g);
        let mut cuts = vec![0.0];
        if to > 0.0 {
            panels::towards_end(&mut cuts, 0.0, to, LONGEST, self.scale(horizon, q));
        }
        let [e, above] = above(self, &cuts, rule);
        let beyond = ops::asinh(2.0 * end / self.g);
        let mut cuts = vec![to];
        if beyond > to {
            panels::towards_end(&mut cuts, to, beyond, LONGEST, 1.0);
        }
        let below = below(self, &cuts, rule);
        let area = 1.0 / (self.g * self.g);
        [e * area, (above + below) * area]
    }

    /// tan(t/2) at the horizon of the light, mu cos(2t) + lean sin(2t) = 0, and where v.h = 0 or
    /// t = pi/2.
    pub(super) fn ends(&self, lean: f64, q: f64) -> [f64; 2] {
        let mu = self.view.mu;
        let half = |opposite: f64, adjacent: f64| {
            if opposite == 0.0 {
                0.0
            } else {
                opposite / (adjacent + (opposite * opposite + adjacent * adjacent).sqrt())
            }
        };
        if lean >= 0.0 { [half(q + lean, mu), 1.0] } else { [half(mu, q - lean), half(mu, -lean)] }
    }

    /// Scale in v on which the shadowing of the light varies at its horizon: s_l has branch points
    /// at mu_l = +-i s_l, and the correlated form a pole at mu_l = -mu s_l/s_v.
    pub(super) fn scale(&self, horizon: f64, q: f64) -> f64 {
        let view = self.view;
        let length2 = 1.0 + horizon * horizon;
        let (cos_t, sin_t) = ((1.0 - horizon * horizon) / length2, 2.0 * horizon / length2);
        let s_l = view.stretched(self.light(cos_t, sin_t));
        let layer = if view.mu > 0.0 { view.mu * s_l / view.s_v } else { s_l };
        let slope = 2.0 * q * 2.0 * (0.25 * self.g * self.g + horizon * horizon).sqrt() / length2;
        layer / slope
    }

    /// The light mirrored about the facet at angle t.
    #[inline(always)]
    fn light(&self, cos_t: f64, sin_t: f64) -> [f64; 3] {
        let view = self.view;
        let vh = view.mu * cos_t + view.sine * sin_t * self.cosine;
        [
            2.0 * vh * sin_t * self.azimuth[0] - view.sine * view.azimuth[0],
            2.0 * vh * sin_t * self.azimuth[1] - view.sine * view.azimuth[1],
            2.0 * vh * cos_t - view.mu,
        ]
    }

    /// The integrands in v, with geometry factors of the light's cosine and alpha_x^2
    /// l_x^2 + alpha_y^2 l_y^2.
    #[inline(always)]
    fn along<const N: usize>(&self, v: &F8, geometry: impl Fn(f64, f64) -> [f64; N]) -> [F8; N] {
        let view = self.view;
        let e = lanes::exp(v);
        let inverse_g2 = 1.0 / (self.g * self.g);
        let mut out = [[0.0; LANES]; N];
        for i in 0..LANES {
            let inverse = 1.0 / e[i];
            let x = 0.25 * self.g * (e[i] - inverse);
            let slope = 0.5 * self.g * (e[i] + inverse);
            let length2 = 1.0 / (1.0 + x * x);
            let (cos_t, sin_t) = ((1.0 - x) * (1.0 + x) * length2, 2.0 * x * length2);
            let vh = (view.mu * cos_t + view.sine * sin_t * self.cosine).max(0.0);
            let light = self.light(cos_t, sin_t);
            let (lx, ly) = (view.alpha[0] * light[0], view.alpha[1] * light[1]);
            let d = cos_t * cos_t + sin_t * sin_t * inverse_g2;
            let factors = geometry(light[2], lx * lx + ly * ly);
            for k in 0..N {
                out[k][i] = sin_t * vh * factors[k] / (d * d) * slope * length2;
            }
        }
        out
    }
}

/// What is kept and what shadowing takes where the light is above its horizon, compiled for the instructions
/// that the processor has. Every form does the same operations in the same order (nothing is contracted), so
/// all give the same bits.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
fn above(ray: &Ray, cuts: &[f64], rule: &PanelRule) -> [f64; 2] {
    let view = ray.view;
    rule.panels_of_all(cuts, &|v| {
        ray.along(v, |mu_l, spread| {
            let mu_l = mu_l.max(0.0);
            let s_l = (mu_l * mu_l + spread).sqrt();
            let lift = spread / (s_l + mu_l);
            [
                view.smith.shadowing_over_cosine(view.mu, view.s_v, mu_l, s_l),
                view.smith.shadowed_over_cosine(view.mu, view.s_v, mu_l, s_l, lift),
            ]
        })
    })
}

/// What is lost where it is below, as [`above`].
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
fn below(ray: &Ray, cuts: &[f64], rule: &PanelRule) -> f64 {
    let masking = 2.0 / (ray.view.mu + ray.view.s_v);
    rule.panels(cuts, &|v| ray.along(v, |_, _| [masking])[0])
}
