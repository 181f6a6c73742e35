//! Monte Carlo for the sheen lobe: facets drawn in proportion to sin^(1/alpha), the view mirrored
//! about each as a vector.

use super::integral::{check, mass};
use super::lobe::{exponent, lit};
use super::shadowed::Fitted;
use crate::integrate::IntegrateError;
use crate::integrate::monte_carlo::{Run, Sampled, check_samples, column, replicas};
use crate::optics::ggx::{self, Vec3};
use lobefit_math::ops;

/// `sheen-charlie` by Monte Carlo: E.
pub fn sheen(alpha: f64, mu: f64, run: Run) -> Result<Sampled, IntegrateError> {
    check(alpha, mu)?;
    albedo(alpha, mu, run, |mu_l| lit(mu, mu_l))
}

/// `sheen-estevez-kulla` by Monte Carlo: E, at a place of its domain.
pub(super) fn shadowed(alpha: f64, mu: f64, run: Run) -> Result<Sampled, IntegrateError> {
    let lambda = Fitted::new(alpha);
    let of_view = lambda.at(mu);
    albedo(alpha, mu, run, |mu_l| 1.0 / (mu * (1.0 + of_view + lambda.at(mu_l))))
}

/// E with 4 mu_l V of the light's cosine.
fn albedo(alpha: f64, mu: f64, run: Run, lit: impl Fn(f64) -> f64 + Sync) -> Result<Sampled, IntegrateError> {
    check_samples(run)?;
    let view = [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu];
    let means = replicas(run, |x| {
        let (light, cosine) = ggx::mirror(view, normal(alpha, x));
        let kept = if light[2] > 0.0 { cosine * lit(light[2].min(1.0)) } else { 0.0 };
        [kept, 0.0, 0.0]
    });
    let (unit, scale) = (column(&means, run.samples, |w| w[0]), mass(alpha));
    Ok(Sampled { value: scale * unit.value, standard_error: scale * unit.standard_error })
}

/// A facet's normal with density proportional to sin^(1/alpha): its cosine is t/sqrt(nu + t^2) of a
/// Student t with nu = 2 + 1/alpha degrees of freedom, drawn by Bailey's polar method (1994).
fn normal(alpha: f64, x: [f64; 3]) -> Vec3 {
    let nu = 2.0 + exponent(alpha);
    let radius2 = ops::expm1(-2.0 / nu * ops::log(1.0 - x[0]));
    let along = ops::cos(2.0 * std::f64::consts::PI * x[1]);
    let t2 = radius2 * along * along;
    let (cosine, sine) = ((t2 / (1.0 + t2)).sqrt(), 1.0 / (1.0 + t2).sqrt());
    let (sin_azimuth, cos_azimuth) = ops::sincos(2.0 * std::f64::consts::PI * x[2]);
    [sine * cos_azimuth, sine * sin_azimuth, cosine]
}
