//! The sheen lobe of Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF" (2017), called
//! Charlie, with the visibility of Neubelt and Pettineo (2013) that real-time renderers pair it
//! with. The shadowing that its authors fitted stands in `shadowed`.

use crate::optics::ggx::Vec3;
use lobefit_math::ops;

/// Exponent of the sine in Charlie's distribution, 1/alpha.
#[inline(always)]
pub fn exponent(alpha: f64) -> f64 {
    1.0 / alpha
}

/// D = (2 + 1/alpha) sin^(1/alpha)(theta_h) / (2 pi) (Estevez and Kulla 2017, eq. 2) of a unit
/// normal, alpha > 0. It is 0 at the pole and largest at grazing; int D cos = 1 over the
/// hemisphere.
#[inline(always)]
pub fn distribution(alpha: f64, normal: Vec3) -> f64 {
    let p = exponent(alpha);
    let sine2 = normal[0] * normal[0] + normal[1] * normal[1];
    (2.0 + p) * ops::pow(sine2, 0.5 * p) / (2.0 * std::f64::consts::PI)
}

/// 4 mu_l V = mu_l / (mu_l + mu_v - mu_l mu_v) (Neubelt and Pettineo 2013), in [0, 1]; both cosines
/// in [0, 1], not both 0.
#[inline(always)]
pub fn lit(mu_v: f64, mu_l: f64) -> f64 {
    mu_l / (mu_v + mu_l * (1.0 - mu_v))
}
