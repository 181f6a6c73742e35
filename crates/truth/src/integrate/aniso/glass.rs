//! `ggx-glass-aniso`: R, T and their loss of a rough dielectric interface whose facets are wider along
//! one tangent than along the other, at an azimuth of the view.
//!
//! The rays of facets are those of the reflection. A facet h of slope s refracts the view v to the
//! horizon where |eta (s mu - v_xy)| = 1, and reflects it totally beyond v.h = sqrt(1 - 1/eta^2): along
//! a ray both are closed forms, and so is the azimuth at which a ray touches them, the same for both.

use multiversion::multiversion;

use super::ray::{LONGEST, Ray};
use super::rays::Rays;
use super::view::View;
use super::{FLOOR, check};
use crate::integrate::glass::{self, Glass, Interface, Side};
use crate::integrate::{IntegrateError, PanelRule};
use crate::optics::Smith;
use lobefit_math::lanes::{self, LANES};
use lobefit_math::{ops, panels};

/// Name of the quantity.
pub const QUANTITY: &str = "ggx-glass-aniso";

/// Tolerance of a value by default: the promise for alpha_x, alpha_y in [0.01, 1] with ratio up to
/// 1:100, mu in [0.01, 1] and ior in [1, 3].
pub const TOLERANCE: f64 = 1e-6;

/// Smallest panel where light grazes or begins to be reflected totally, where the integrand is a square
/// root.
const FINEST: f64 = 1e-5;

/// Integrates R, T and the loss at widths along the tangent and across it, both in [1e-4, 4] or both 0,
/// mu in [1e-6, 1], the azimuth phi of the view and ior = n_inside/n_outside in [1, 4]; `side` is where
/// the ray comes from.
pub fn glass(
    smith: Smith,
    alpha: [f64; 2],
    [mu, phi]: [f64; 2],
    (ior, side): (f64, Side),
    tolerance: f64,
) -> Result<Glass, IntegrateError> {
    check(QUANTITY, alpha, mu, Some(phi))?;
    // Of width 1, whatever the lobe's.
    glass::check(QUANTITY, 1.0, mu, ior)?;
    let interface = Interface::new(ior, side);
    if alpha == [0.0, 0.0] {
        return Ok(glass::smooth(interface, mu));
    }
    let rays = Rays::with(View::new(smith, alpha, mu, phi), |view| touches(view, interface));
    let values = |n| {
        let rule = PanelRule::new(n);
        rays.integrate(&rule, |ray| energies(ray, interface, &rule))
    };
    let [x, y] = alpha;
    let place = || format!("alpha_x = {x:?}, alpha_y = {y:?}, mu = {mu:?}, phi = {phi:?}, ior = {ior:?}");
    glass::refined((QUANTITY, &place), values, FLOOR, tolerance)
}

/// Directions of the rays, as (x, y), that touch the circle of facets whose refracted light grazes or that
/// end where total reflection begins, and the scale about them.
fn touches(view: &View, interface: Interface) -> Vec<([f64; 2], f64)> {
    let Some([sine, cosine]) = interface.critical().filter(|_| view.sine > 0.0) else { return Vec::new() };
    let [cos_phi, sin_phi] = view.azimuth;
    let both = |cosine: f64, scale: f64| {
        let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
        [-sine, sine].map(|s| ([cos_phi * cosine - sin_phi * s, sin_phi * cosine + cos_phi * s], scale))
    };
    let ratio = sine / view.sine;
    let inside = (1.0 - ratio) * (1.0 + ratio);
    // With the macro normal inside, the distance to the circle turns as fast as it is near.
    let touching = both(inside.max(0.0).sqrt(), inside.min(0.0).abs().sqrt().clamp(FINEST, 1.0));
    let level = cosine / view.sine;
    touching.into_iter().chain(both(level.min(1.0), FINEST).into_iter().filter(|_| level < 1.0)).collect()
}

/// R, T and loss of a ray, each times g^2 as the reflection's.
fn energies(ray: &Ray, interface: Interface, rule: &PanelRule) -> [f64; 3] {
    let (mu, lean) = (ray.view.mu, ray.view.sine * ray.cosine);
    let q = (mu * mu + lean * lean).sqrt();
    let [horizon, end] = ray.ends(lean, q);
    let v = |x: f64| ops::asinh(2.0 * x / ray.g);
    let rim = (interface.contrast.abs().sqrt() / interface.eta).clamp(FINEST, 1.0);
    let mut cuts = vec![(0.0, 1.0), (v(end), rim)];
    if horizon < end {
        cuts.push((v(horizon), ray.scale(horizon, q)));
    }
    if let Some([sine, cosine]) = interface.critical() {
        let root = lean * lean - ray.view.sine * ray.view.sine + sine * sine;
        if root >= 0.0 {
            let (peak, reach) = (ops::atan2(lean, mu), ops::atan2(root.sqrt(), cosine));
            let grazing = [-1.0, 1.0].map(|sign| ops::atan2(lean + sign * root.sqrt(), mu));
            let angles = grazing.into_iter().chain([peak - reach, peak + reach]);
            let places = angles.filter(|t| *t > 0.0).map(|t| v(ops::tan(0.5 * t)));
            cuts.extend(places.filter(|place| *place < v(end)).map(|place| (place, FINEST)));
        }
    }
    cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut all = vec![0.0];
    for pair in cuts.windows(2).filter(|pair| pair[1].0 - pair[0].0 > 1e-12) {
        panels::towards_both(&mut all, pair[0].0, pair[1].0, LONGEST, [pair[0].1, pair[1].1]);
    }
    let area = 1.0 / (ray.g * ray.g);
    along(ray, interface, &all, rule).map(|sum| sum * area)
}

/// The energies along the panels, compiled for the instructions that the processor has. Every form does the
/// same operations in the same order (nothing is contracted), so all give the same bits.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
fn along(ray: &Ray, interface: Interface, cuts: &[f64], rule: &PanelRule) -> [f64; 3] {
    rule.panels_of_all(cuts, &|v| {
        let e = lanes::exp(v);
        let mut out = [[0.0; LANES]; 3];
        for i in 0..LANES {
            for (sums, value) in out.iter_mut().zip(facet(ray, interface, e[i])) {
                sums[i] = value;
            }
        }
        out
    })
}

/// The integrands at the facet of exp(v).
#[inline(always)]
fn facet(ray: &Ray, interface: Interface, e: f64) -> [f64; 3] {
    let (view, g) = (ray.view, ray.g);
    let inverse = 1.0 / e;
    let (x, slope) = (0.25 * g * (e - inverse), 0.5 * g * (e + inverse));
    let length2 = 1.0 / (1.0 + x * x);
    let (cos_t, sin_t) = ((1.0 - x) * (1.0 + x) * length2, 2.0 * x * length2);
    let c = (view.mu * cos_t + view.sine * sin_t * ray.cosine).clamp(1e-150, 1.0);
    let s = ((1.0 - c) * (1.0 + c)).sqrt().max(1e-150);
    let facet = interface.facet(c, s);
    let [straight, turned] = facet.deviation;
    // -l = cos(delta) v + sin(delta) (h - c v)/s
    let (of_h, of_v) = (turned / s, straight - turned / s * c);
    let h = [sin_t * ray.azimuth[0], sin_t * ray.azimuth[1], cos_t];
    let v = [view.sine * view.azimuth[0], view.sine * view.azimuth[1], view.mu];
    let mirrored = [0, 1, 2].map(|k| 2.0 * c * h[k] - v[k]);
    let refracted = [0, 1, 2].map(|k| of_v * v[k] + of_h * h[k]);
    let [kept_r, lost_r] = shadowed(view, mirrored);
    let [kept_t, lost_t] = shadowed(view, refracted);
    let d = cos_t * cos_t + sin_t * sin_t / (g * g);
    let weight = sin_t * c / (d * d) * slope * length2;
    let (reflected, passed) = (weight * facet.fresnel, weight * (1.0 - facet.fresnel));
    [reflected * kept_r, passed * kept_t, reflected * lost_r + passed * lost_t]
}

/// G2/mu and (G1 - G2)/mu of a direction; below the horizon all is lost.
#[inline(always)]
fn shadowed(view: &View, [x, y, z]: [f64; 3]) -> [f64; 2] {
    let (mu, s_v) = (view.mu, view.s_v);
    let (x, y) = (view.alpha[0] * x, view.alpha[1] * y);
    let (z, spread) = (z.max(0.0), x * x + y * y);
    let s = (z * z + spread).sqrt();
    let lift = spread / (s + z);
    let kept = view.smith.shadowing_over_cosine(mu, s_v, z, s);
    let lost = view.smith.shadowed_over_cosine(mu, s_v, z, s, lift);
    [if z > 0.0 { kept } else { 0.0 }, if z > 0.0 { lost } else { 2.0 / (mu + s_v) }]
}
