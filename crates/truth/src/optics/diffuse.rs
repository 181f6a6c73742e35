//! A diffuse base under a specular lobe: how published models couple the two.
//!
//! Each returns the factor of albedo/pi, the BRDF of a Lambertian base, except where it says
//! otherwise. F is Fresnel's reflectance at the cosine named, f0 that at normal incidence; cosines
//! lie in [0, 1].

use super::fresnel::schlick_weight;

/// Half a polynomial of degree 5, which the average over the hemisphere inverts: 1 - (1 - mu/2)^5;
/// 0 at mu = 0, 31/32 at mu = 1.
#[inline(always)]
fn half_power(mu: f64) -> f64 {
    1.0 - schlick_weight(1.0 - 0.5 * mu)
}

/// Ashikhmin and Shirley 2000, the diffuse term:
/// (28/23)(1 - f0)(1 - (1 - mu_l/2)^5)(1 - (1 - mu_v/2)^5), reciprocal. 28/23 makes the base with
/// f0 = 0 white on average: 2 int (1 - (1 - mu/2)^5) mu dmu = 23/28.
#[inline(always)]
pub fn ashikhmin_shirley(f0: f64, mu_l: f64, mu_v: f64) -> f64 {
    28.0 / 23.0 * (1.0 - f0) * (half_power(mu_l) * half_power(mu_v))
}

/// The product (21/20)(1 - F(l))(1 - F(v))/(1 - f0), reciprocal: with Schlick's Fresnel
/// 1 - F = (1 - f0)(1 - (1 - mu)^5), whose average is 20/21 of 1 - f0, so that it keeps 1 - F(v) of
/// a white base. 0 at f0 = 1.
#[inline(always)]
pub fn fresnel_product(f0: f64, mu_l: f64, mu_v: f64) -> f64 {
    let passed = |mu: f64| 1.0 - schlick_weight(1.0 - mu);
    21.0 / 20.0 * (1.0 - f0) * (passed(mu_l) * passed(mu_v))
}

/// 1 less Schlick's Fresnel with a roughness term, 1 - f0 - (max(1 - roughness, f0) - f0)(1 - mu)^5
/// (S. Lagarde; Fdez-Aguera 2019, k_S).
#[inline(always)]
pub fn schlick_roughness(f0: f64, roughness: f64, mu: f64) -> f64 {
    let smooth = 1.0 - roughness;
    1.0 - f0 - (if smooth < f0 { 0.0 } else { smooth - f0 }) * schlick_weight(1.0 - mu)
}

/// mix(1 - F(mu), 1 - f0, roughness), roughness = sqrt(alpha) (Pesce 2019).
#[inline(always)]
pub fn pesce(f0: f64, f: f64, roughness: f64) -> f64 {
    (1.0 - f) + ((1.0 - f0) - (1.0 - f)) * roughness
}

/// The base of the Enterprise PBR Shading Model (Dassault Systemes), reciprocal: left(l)
/// left(v)/(1 - average) with a fit of what its lobe leaves, left(mu) = 1 - mix(F(mu), F_avg,
/// 1 - (1 - alpha)^5), Schlick's F, F_avg = 0.04762 + 0.95238 f0 and average = f0 - (0.33263
/// alpha + 0.072359)(1 - f0) f0. Written with 1 - f0 cancelled, so that f0 = 1 has its limit 0.
#[inline(always)]
pub fn dassault(f0: f64, alpha: f64, mu_l: f64, mu_v: f64) -> f64 {
    let smooth = schlick_weight(1.0 - alpha);
    // left(mu)/(1 - f0)
    let left = |mu: f64| (1.0 - schlick_weight(1.0 - mu)) * smooth + 0.95238 * (1.0 - smooth);
    (1.0 - f0) * (left(mu_l) * left(mu_v)) / (1.0 + (0.33263 * alpha + 0.072359) * f0)
}

/// What a specular lobe leaves on the way in and on the way out, reciprocal: left(l)
/// left(v)/left_avg (Kelemen and Szirmay-Kalos 2001, with 1 - E for `left`), left = 1 less the
/// albedo of the specular lobe as it is drawn and left_avg its cosine-weighted average. The average
/// over l is left_avg, so that exactly left(v) comes back from a white base. 0 at left_avg = 0.
#[inline(always)]
pub fn kelemen(left_l: f64, left_v: f64, left_avg: f64) -> f64 {
    if left_avg == 0.0 { 0.0 } else { left_l * left_v / left_avg }
}

/// [`kelemen`] with the light that goes back and forth between a base of albedo `rho` and the lobe
/// above it: left(l) left(v)/(1 - rho taken_avg), taken_avg = 1 - left_avg, to be multiplied with
/// rho/pi. A white base gives [`kelemen`], a dark one absorbs more than `rho` of it: the albedo is
/// rho left(v) left_avg/(1 - rho taken_avg) <= rho left(v).
#[inline(always)]
pub fn interreflected(rho: f64, left_l: f64, left_v: f64, left_avg: f64) -> f64 {
    // 1 - rho (1 - left_avg) without cancellation at rho = 1
    let below = (1.0 - rho) + rho * left_avg;
    if below == 0.0 { 0.0 } else { left_l * left_v / below }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::fresnel;
    use lobefit_math::gauss::Gauss;

    #[test]
    fn the_constants_are_averages() {
        let rule = Gauss::new(16);
        let average = |f: &dyn Fn(f64) -> f64| rule.integrate(0.0, 1.0, |mu| 2.0 * mu * f(mu));
        assert!((average(&half_power) - 23.0 / 28.0).abs() < 1e-15);
        assert!((average(&|mu| fresnel_product(0.0, mu, 1.0)) - 1.0).abs() < 1e-15);
        assert!(
            (average(&|mu| fresnel::schlick(0.3, 1.0 - mu)) - fresnel::schlick_average(0.3)).abs() < 1e-15
        );
    }

    #[test]
    fn ends_are_the_limits() {
        assert_eq!(pesce(0.04, 0.4, 0.0), 0.6);
        assert_eq!(pesce(0.04, 0.4, 1.0), 0.96);
        assert_eq!(schlick_roughness(0.04, 1.0, 0.2), 0.96);
        assert_eq!(kelemen(0.0, 0.0, 0.0), 0.0);
        assert_eq!(interreflected(1.0, 0.3, 0.4, 0.2), kelemen(0.3, 0.4, 0.2));
        assert_eq!(interreflected(0.0, 0.3, 0.4, 0.2), 0.3 * 0.4);
    }
}
