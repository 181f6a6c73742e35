//! Lobes about an axis as cubemaps are prefiltered with them, by the share of energy inside a cone.
//!
//! theta is the angle from the axis, u = tan^2(theta/2), c = cos(theta) = (1 - u)/(1 + u), A = alpha^2; a lobe covers the hemisphere
//! u <= 1 and holds energy 1 there. With dc = -2/(1 + u)^2 du the unnormalised densities over u are
//!
//!   `ndf`          D(theta):                    2/((1 + u) (1 - (1-A) c^2))^2,
//!   `half`         D(theta/2):                  2/(A + u)^2,
//!   `half-cosine`  D(theta/2) cos(theta):       (1 - u)/((A + u)^2 (1 + u)),
//!
//! and all three have elementary integrals. The last is what engines bake (view, normal and mirror direction taken for one, samples
//! weighted by their cosine: Karis 2013).

use crate::math::gauss::Gauss;
use crate::math::ops;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Which lobe.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Kernel {
    /// GGX's distribution of normals over the angle itself.
    Ndf,
    /// GGX's distribution over half the angle: reflection about the axis.
    Half,
    /// The same, weighted by the cosine: what prefiltering bakes.
    #[default]
    HalfCosine,
}

impl Kernel {
    /// All of them.
    pub const ALL: [Kernel; 3] = [Kernel::Ndf, Kernel::Half, Kernel::HalfCosine];

    /// The word used in options, headers and names.
    pub fn name(self) -> &'static str {
        match self {
            Kernel::Ndf => "ndf",
            Kernel::Half => "half",
            Kernel::HalfCosine => "half-cosine",
        }
    }

    /// In a formula.
    pub fn formula(self) -> &'static str {
        match self {
            Kernel::Ndf => "D(theta)",
            Kernel::Half => "D(theta/2)",
            Kernel::HalfCosine => "D(theta/2) cos(theta)",
        }
    }

    /// The power of the tangent with which the energy outside a wide cone falls: the density at the horizon is 0 or not.
    pub fn decay(self) -> f64 {
        if self == Kernel::HalfCosine { 2.0 } else { 1.0 }
    }

    /// The lobe of a width alpha in (0, 2]: above 1 it is wider than any that a shader has, and rises towards the horizon.
    pub fn lobe(self, alpha: f64) -> Lobe {
        let mut lobe = Lobe { kernel: self, a2: alpha * alpha, whole: 1.0 };
        lobe.whole = lobe.within(1.0);
        lobe
    }
}

/// A lobe of some width.
#[derive(Clone, Copy, Debug)]
pub struct Lobe {
    kernel: Kernel,
    a2: f64,
    /// The unnormalised energy of the hemisphere.
    whole: f64,
}

/// Widths whose square lies between this and its inverse are integrated by a rule: closed forms cancel at alpha = 1.
const NEAR_ONE: f64 = 0.5;

/// Newton's steps or, where one leaves the interval, halvings: far more than are taken.
const QUANTILE_STEPS: usize = 200;

/// On [0, u <= 1] the density's poles -A <= -1/2 and -1 leave (2 + sqrt 3)^-32 = 5e-19.
static RULE: LazyLock<Gauss> = LazyLock::new(|| Gauss::new(16));

impl Lobe {
    /// The share of energy inside a cone, by the tangent t >= 0 of its angle; an infinite tangent is the horizon, where it is 1.
    /// Absolute error below 1e-14.
    pub fn encircled(&self, t: f64) -> f64 {
        self.within(half_tangent2(t)) / self.whole
    }

    /// The derivative of [`Lobe::encircled`] by ln t.
    pub fn slope(&self, t: f64) -> f64 {
        let u = half_tangent2(t);
        // du/d ln t = 2 u (1 - u)/(1 + u)
        self.density(u) * 2.0 * u * (1.0 - u) / (1.0 + u) / self.whole
    }

    /// The u = tan^2(theta/2) of the cone that holds a share `energy` in [0, 1]; to 1e-12 of itself.
    pub fn quantile(&self, energy: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        // what `half` holds: the other two are near it where they are narrow
        let wanted = energy.clamp(0.0, 1.0);
        let mut u = (self.a2 * wanted / (1.0 + self.a2 - wanted)).clamp(f64::MIN_POSITIVE, 1.0);
        for _ in 0..QUANTILE_STEPS {
            let off = self.within(u) / self.whole - wanted;
            if off > 0.0 {
                high = u
            } else {
                low = u
            }
            let next = u - off * self.whole / self.density(u);
            let inside = next > low && next < high;
            let next = if inside { next } else { 0.5 * (low + high) };
            if (next - u).abs() <= 1e-13 * u {
                return next;
            }
            u = next;
        }
        u
    }

    /// The share of energy per solid angle at u = tan^2(theta/2) in [0, 1]: dc = -2/(1 + u)^2 du.
    pub fn per_solid_angle(&self, u: f64) -> f64 {
        self.density(u) * (1.0 + u) * (1.0 + u) / (4.0 * PI * self.whole)
    }

    /// Unnormalised density over u.
    fn density(&self, u: f64) -> f64 {
        let a2 = self.a2;
        match self.kernel {
            Kernel::Ndf => {
                let across = self.across(u) * (1.0 + u);
                2.0 / (across * across)
            }
            Kernel::Half => 2.0 / ((a2 + u) * (a2 + u)),
            Kernel::HalfCosine => (1.0 - u) / ((a2 + u) * (a2 + u) * (1.0 + u)),
        }
    }

    /// 1 - (1-A) c^2 = A + (1-A) sin^2(theta).
    fn across(&self, u: f64) -> f64 {
        self.a2 + (1.0 - self.a2) * 4.0 * u / ((1.0 + u) * (1.0 + u))
    }

    /// Unnormalised energy from the axis to u in [0, 1].
    fn within(&self, u: f64) -> f64 {
        let a2 = self.a2;
        if self.kernel == Kernel::Half {
            return 2.0 * u / (a2 * (a2 + u));
        }
        if (NEAR_ONE..=1.0 / NEAR_ONE).contains(&a2) {
            return RULE.integrate(0.0, u, |v| self.density(v));
        }
        match self.kernel {
            Kernel::Ndf => self.beyond(0.0) - self.beyond(u),
            _ => {
                let rest = 1.0 - a2;
                let logarithms = ops::log1p(u) - ops::log1p(u / a2);
                2.0 / (rest * rest) * logarithms + (1.0 + a2) / rest * u / (a2 * (a2 + u))
            }
        }
    }

    /// int_0^c dx/(1 - k x^2)^2 = c/(2 (1 - k c^2)) + artanh(sqrt(k) c)/(2 sqrt(k)), k = 1 - A: the energy of `ndf` beyond u.
    fn beyond(&self, u: f64) -> f64 {
        let (k, c, across) = (1.0 - self.a2, (1.0 - u) / (1.0 + u), self.across(u));
        let y = k.abs().sqrt() * c;
        // artanh y = ln((1 + y)^2/(1 - y^2))/2, and 1 - y^2 is `across`, which does not cancel
        let inverse = if k > 0.0 { 0.5 * ops::log((1.0 + y) * (1.0 + y) / across) } else { ops::atan(y) };
        0.5 * (c / across + inverse / k.abs().sqrt())
    }
}

/// tan^2(theta/2) of a tangent: (t/(1 + sqrt(1 + t^2)))^2, without overflow.
fn half_tangent2(t: f64) -> f64 {
    let half = if t > 1.0 {
        let inverse = 1.0 / t;
        1.0 / (inverse + (1.0 + inverse * inverse).sqrt())
    } else {
        t / (1.0 + (1.0 + t * t).sqrt())
    };
    half * half
}
