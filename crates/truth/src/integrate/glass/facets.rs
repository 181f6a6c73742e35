//! What the sweeps over facets need of a distribution of normals.
//!
//! A facet lies at the depth 1 - h_z below the macro normal.

use std::f64::consts::PI;

use crate::optics::beckmann::Beckmann;
use crate::optics::distribution::{Distribution, Ggx};

/// A distribution that glass may have.
pub trait Facets: Distribution {
    /// tan(theta_h)/alpha beyond which nothing is left beside the whole: infinite of a power.
    const SPAN: f64;

    /// Twice D at a depth.
    fn twice(self, depth: f64) -> f64;

    /// By how much a depth grows beyond `low` until D has another form: to its pole, or where a
    /// Gaussian falls by a factor e.
    fn width(self, low: f64) -> f64;

    /// The depth at which D is nothing beside that at `low`.
    fn deepest(self, low: f64) -> f64;
}

impl Facets for Ggx {
    const SPAN: f64 = f64::INFINITY;

    #[inline(always)]
    fn twice(self, depth: f64) -> f64 {
        let a2 = self.0 * self.0;
        let sin2 = depth * (2.0 - depth);
        let d = sin2 + a2 * (1.0 - sin2);
        2.0 * a2 / (PI * d * d)
    }

    /// D has its pole at h_z = 1/sqrt(1 - a^2).
    fn width(self, low: f64) -> f64 {
        let rest = (1.0 - self.0) * (1.0 + self.0);
        let pole = self.0 * self.0 / (rest + rest.sqrt());
        pole + low
    }

    fn deepest(self, _: f64) -> f64 {
        f64::INFINITY
    }
}

impl Facets for Beckmann {
    /// exp(-6.5^2) is 4e-19.
    const SPAN: f64 = 6.5;

    fn twice(self, depth: f64) -> f64 {
        let (a2, cosine) = (self.0 * self.0, 1.0 - depth);
        let (sin2, cos2) = (depth * (2.0 - depth), cosine * cosine);
        let exponent = sin2 / (a2 * cos2);
        if cosine > 0.0 && exponent < Self::REACH * Self::REACH {
            2.0 * lobefit_math::ops::exp(-exponent) / (PI * a2 * cos2 * cos2)
        } else {
            0.0
        }
    }

    /// tan^2 rises by 2/h_z^3 times the depth.
    fn width(self, low: f64) -> f64 {
        let cosine = (1.0 - low).max(0.0);
        (0.5 * self.0 * self.0 * cosine * cosine * cosine).max(f64::MIN_POSITIVE)
    }

    fn deepest(self, low: f64) -> f64 {
        let cosine = 1.0 - low;
        if cosine <= 0.0 {
            return low;
        }
        let span = Self::SPAN * self.0;
        let tan2 = low * (2.0 - low) / (cosine * cosine) + span * span;
        let secant = (1.0 + tan2).sqrt();
        tan2 / (secant * (secant + 1.0))
    }
}
