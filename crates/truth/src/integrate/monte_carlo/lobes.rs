//! Monte Carlo for the anisotropic and the glass lobe: visible normals, textbook Fresnel and
//! refraction as vectors.

use super::draw::{self, Draw, Lobe};
use super::{Points, Run, Sampled, Weights, check_samples, column, replicas};
use crate::integrate::IntegrateError;
use crate::integrate::aniso::{check as check_aniso, glass::QUANTITY};
use crate::integrate::glass::{SMALLEST_MU, Side, check as check_glass};
use crate::optics::Smith;
use crate::optics::distribution::{Distribution, Ggx};
use crate::optics::ggx::{self, Vec3};
use lobefit_math::ops;
use lobefit_math::sobol::DIMENSIONS;

/// `ggx-reflection-aniso` by Monte Carlo: E and loss; without phi, the third coordinate draws the
/// view's azimuth.
pub fn aniso(
    smith: Smith,
    alpha: [f64; 2],
    mu: f64,
    phi: Option<f64>,
    run: Run,
) -> Result<[Sampled; 2], IntegrateError> {
    check_aniso("ggx-reflection-aniso", alpha, mu, phi)?;
    check_positive("ggx-reflection-aniso", &[("alpha_x", alpha[0]), ("alpha_y", alpha[1]), ("mu", mu)])?;
    check_samples(run)?;
    let means = replicas(run, |x| {
        let view = view_at(mu, phi.unwrap_or(2.0 * std::f64::consts::PI * x[2]));
        draw::sample((smith, run.draw), &alpha, view, x)
    });
    Ok([column(&means, run.samples, |w| w[0]), column(&means, run.samples, |w| w[2])])
}

/// The view of a cosine and an azimuth.
pub(crate) fn view_at(mu: f64, phi: f64) -> Vec3 {
    let (sine, (sin_phi, cos_phi)) = (((1.0 - mu) * (1.0 + mu)).sqrt(), ops::sincos(phi));
    [sine * cos_phi, sine * sin_phi, mu]
}

/// `ggx-glass` by Monte Carlo: R, T and loss.
pub fn glass(
    smith: Smith,
    alpha: f64,
    mu: f64,
    ior: f64,
    side: Side,
    run: Run,
) -> Result<[Sampled; 3], IntegrateError> {
    glass_of("ggx-glass", (smith, Ggx(alpha)), mu, (ior, side), run)
}

/// [`glass`] of any distribution of normals. Lights are not drawn: of a direction alone nothing says
/// which facet refracts towards it.
pub(crate) fn glass_of<D: Distribution>(
    quantity: &'static str,
    (smith, lobe): (Smith, D),
    mu: f64,
    (ior, side): (f64, Side),
    run: Run,
) -> Result<[Sampled; 3], IntegrateError> {
    check_glass(quantity, lobe.alpha(), mu, ior)?;
    check_positive(quantity, &[("alpha", lobe.alpha())])?;
    check_samples(run)?;
    drawn_glass((smith, lobe), draw::view(mu), (ior, side), run)
}

/// `ggx-glass-aniso` by Monte Carlo: R, T and loss.
pub fn aniso_glass(
    smith: Smith,
    alpha: [f64; 2],
    [mu, phi]: [f64; 2],
    (ior, side): (f64, Side),
    run: Run,
) -> Result<[Sampled; 3], IntegrateError> {
    check_aniso(QUANTITY, alpha, mu, Some(phi))?;
    check_glass(QUANTITY, 1.0, mu, ior)?;
    check_positive(QUANTITY, &[("alpha_x", alpha[0]), ("alpha_y", alpha[1])])?;
    check_samples(run)?;
    drawn_glass((smith, alpha), view_at(mu, phi), (ior, side), run)
}

fn drawn_glass<L: Lobe>(
    (smith, lobe): (Smith, L),
    view: Vec3,
    (ior, side): (f64, Side),
    run: Run,
) -> Result<[Sampled; 3], IntegrateError> {
    if !super::GLASS_DRAWS.contains(&run.draw) {
        let must = "of glass must be ndf or visible";
        return Err(IntegrateError::Option { option: "draw", value: run.draw.name().into(), must });
    }
    let means = replicas(run, |x| one_of_glass((smith, run.draw), &lobe, eta(ior, side), view, x));
    Ok([0, 1, 2].map(|i| column(&means, run.samples, |w| w[i])))
}

/// n_view/n_far.
fn eta(ior: f64, side: Side) -> f64 {
    match side {
        Side::Outside => 1.0 / ior,
        Side::Inside => ior,
    }
}

/// The light that a sample of visible normals keeps on both sides.
pub(crate) fn traced_glass<'a, L: Lobe + 'a>(
    smith: Smith,
    lobe: L,
    view: Vec3,
    (ior, side): (f64, Side),
) -> Box<dyn Fn([f64; 3]) -> f64 + 'a> {
    let eta = eta(ior, side);
    Box::new(move |x| {
        let [r, t, _] = one_of_glass((smith, Draw::VisibleNormal), &lobe, eta, view, x);
        r + t
    })
}

/// Averages of `ggx-coat` at alpha in [1e-4, 1] and ior in [1, 4]: what is reflected from outside, what
/// is transmitted, what is reflected from inside. The third coordinate draws the cosine, mu^2 uniform.
pub fn coat(smith: Smith, alpha: f64, ior: f64, run: Run) -> Result<[Sampled; 3], IntegrateError> {
    check_glass("ggx-coat", alpha, 1.0, ior)?;
    check_positive("ggx-coat", &[("alpha", alpha)])?;
    check_samples(run)?;
    let means = replicas(run, |x| {
        let mu = x[2].sqrt().max(SMALLEST_MU);
        let view = [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu];
        let way = (smith, Draw::VisibleNormal);
        let [r, t, _] = one_of_glass(way, &Ggx(alpha), 1.0 / ior, view, x);
        [r, t, one_of_glass(way, &Ggx(alpha), ior, view, x)[0]]
    });
    Ok([0, 1, 2].map(|i| column(&means, run.samples, |w| w[i])))
}

/// Reflected, transmitted and lost energy of one normal. The weight of a normal by D cos is that of a
/// visible one, G2/G1(v) on either side, times G1(v) (v.h)/(mu_v h_z).
fn one_of_glass<L: Lobe>(
    (smith, draw): (Smith, Draw),
    lobe: &L,
    eta: f64,
    view: Vec3,
    x: [f64; DIMENSIONS],
) -> Weights {
    let drawn = draw == Draw::Normal;
    let normal = if drawn { lobe.normal(x) } else { lobe.visible_normal(view, x) };
    let of_view = lobe.lambda_towards(view);
    let (mirrored, cosine) = ggx::mirror(view, normal);
    if drawn && cosine <= 0.0 {
        return [0.0, 0.0, 1.0];
    }
    let (reflectance, refracted) = refract(eta, view, normal);
    let (mut kept_r, mut kept_t, mut lost) = (0.0, 0.0, 0.0);
    if mirrored[2] > 0.0 {
        let (kept, shadowed) = shadowing_of(smith, of_view, lobe.lambda_towards(mirrored));
        kept_r = reflectance * kept;
        lost += reflectance * shadowed;
    } else {
        lost += reflectance;
    }
    match refracted {
        Some(light) if light[2] < 0.0 => {
            let (kept, shadowed) = shadowing_of(smith, of_view, lobe.lambda_towards(light));
            kept_t = (1.0 - reflectance) * kept;
            lost += (1.0 - reflectance) * shadowed;
        }
        _ => lost += 1.0 - reflectance,
    }
    if drawn {
        let scale = cosine / ((1.0 + of_view) * view[2] * normal[2]);
        return [kept_r * scale, kept_t * scale, 1.0 - scale * (kept_r + kept_t)];
    }
    [kept_r, kept_t, lost]
}

/// Reflectance of a facet, and where it refracts the view, of n_view/n_far; `None` at total reflection.
pub(crate) fn refract(eta: f64, view: Vec3, normal: Vec3) -> (f64, Option<Vec3>) {
    let cosine = ggx::mirror(view, normal).1;
    let square = 1.0 - eta * eta * (1.0 - cosine * cosine);
    if square <= 0.0 {
        return (1.0, None);
    }
    let cosine_t = square.sqrt();
    let s = (eta * cosine - cosine_t) / (eta * cosine + cosine_t);
    let p = (cosine - eta * cosine_t) / (cosine + eta * cosine_t);
    let along = eta * cosine - cosine_t;
    let light = [0, 1, 2].map(|i| along * normal[i] - eta * view[i]);
    (0.5 * (s * s + p * p), Some(light))
}

/// G2/G1(v) and its complement for a direction on either side of the surface.
pub(crate) fn shadowing(smith: Smith, alpha: [f64; 2], view: Vec3, light: Vec3) -> (f64, f64) {
    shadowing_of(smith, ggx::lambda_towards(alpha, view), ggx::lambda_towards(alpha, light))
}

/// The same of both Lambdas.
pub(super) fn shadowing_of(smith: Smith, of_view: f64, of_light: f64) -> (f64, f64) {
    match smith {
        Smith::Correlated => {
            let total = 1.0 + of_view + of_light;
            ((1.0 + of_view) / total, of_light / total)
        }
        Smith::Separable => (1.0 / (1.0 + of_light), of_light / (1.0 + of_light)),
    }
}

pub(crate) fn check_positive(
    quantity: &'static str,
    inputs: &[(&'static str, f64)],
) -> Result<(), IntegrateError> {
    let domain = "is a limit that Monte Carlo cannot sample; use quadrature";
    IntegrateError::outside(quantity, inputs.iter().map(|(input, x)| (*input, *x, *x != 0.0, domain)))
}

/// The settings of a second opinion: scrambled Sobol points.
pub fn sobol(samples: u64, seed: u64) -> Run {
    Run { samples, seed, points: Points::Sobol, draw: Draw::VisibleNormal }
}
