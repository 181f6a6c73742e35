//! The sheen lobe of Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF" (2017), called
//! Charlie, with the visibility of Neubelt and Pettineo (2013) that real-time renderers pair it
//! with, and with the shadowing that its authors fitted.

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

/// The Lambda that Estevez and Kulla fitted to the shadowing of their distribution (2017, sec. 3).
#[derive(Clone, Copy, Debug)]
pub struct Lambda([f64; 5]);

/// Their a, b, c, d, e at alpha = 0 and at alpha = 1 (2017, table 1).
const FITTED: [[f64; 5]; 2] =
    [[25.3245, 3.32435, 0.16801, -1.27393, -4.85967], [21.5473, 3.82987, 0.19823, -1.97760, -4.32054]];

impl Lambda {
    /// Of a width in [0, 1]: their constants blended by (1 - alpha)^2.
    pub fn new(alpha: f64) -> Lambda {
        let smooth = (1.0 - alpha) * (1.0 - alpha);
        Lambda([0, 1, 2, 3, 4].map(|k| smooth * FITTED[0][k] + (1.0 - smooth) * FITTED[1][k]))
    }

    /// Lambda of a cosine in [0, 1]: e^L(cosine) below 1/2, e^(2 L(1/2) - L(1 - cosine)) above, whose
    /// second derivative jumps at 1/2.
    pub fn at(self, cosine: f64) -> f64 {
        let exponent = if cosine < 0.5 {
            self.exponent(cosine)
        } else {
            2.0 * self.exponent(0.5) - self.exponent(1.0 - cosine)
        };
        ops::exp(exponent)
    }

    /// L(x) = a/(1 + b x^c) + d x + e.
    fn exponent(self, x: f64) -> f64 {
        let [a, b, c, d, e] = self.0;
        a / (1.0 + b * ops::pow(x, c)) + d * x + e
    }
}
