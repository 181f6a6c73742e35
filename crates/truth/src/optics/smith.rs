//! The masking-shadowing form without which a GGX figure means nothing.

use serde::{Deserialize, Serialize};

/// The Smith masking-shadowing form (Heitz 2014): part of a quantity's name wherever it is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Smith {
    /// Height-correlated, G2 = 1/(1 + Lambda_v + Lambda_l) (Heitz 2014, eq. 99).
    #[default]
    Correlated,
    /// Separable, G2 = G1(v) G1(l).
    Separable,
}

impl Smith {
    /// Both forms, the usual one first.
    pub const ALL: [Smith; 2] = [Smith::Correlated, Smith::Separable];

    /// The word used in file names, headers, the manifest and options.
    pub fn name(self) -> &'static str {
        match self {
            Smith::Correlated => "correlated",
            Smith::Separable => "separable",
        }
    }

    /// Probability that a microfacet seen from v is also lit from l: G2/G1(v), in [0, 1], of
    /// Lambdas that are at least 0. Correlated (1 + Lambda_v)/(1 + Lambda_v + Lambda_l), separable
    /// 1/(1 + Lambda_l).
    #[inline(always)]
    pub fn lit_given_visible(self, of_view: f64, of_light: f64) -> f64 {
        match self {
            Smith::Correlated => 1.0 / (1.0 + of_light / (1.0 + of_view)),
            Smith::Separable => 1.0 / (1.0 + of_light),
        }
    }

    /// The complement 1 - G2/G1(v), computed directly.
    #[inline(always)]
    pub fn shadowed_given_visible(self, of_view: f64, of_light: f64) -> f64 {
        match self {
            Smith::Correlated => of_light / (1.0 + of_view + of_light),
            Smith::Separable => of_light / (1.0 + of_light),
        }
    }

    /// Geometry factor of the reflection integral, G2/mu_v with no 0/0 at mu_v = 0: correlated 2
    /// mu_l/(mu_l s_v + mu_v s_l), separable 4 mu_l/((mu_v + s_v)(mu_l + s_l)), s = mu (1 + 2
    /// Lambda) the projected area of all facets
    /// ([`Distribution::area`](super::distribution::Distribution::area)).
    #[inline(always)]
    pub fn shadowing_over_cosine(self, mu_v: f64, s_v: f64, mu_l: f64, s_l: f64) -> f64 {
        match self {
            Smith::Correlated => 2.0 * mu_l / (mu_l * s_v + mu_v * s_l),
            Smith::Separable => 4.0 * mu_l / ((mu_v + s_v) * (mu_l + s_l)),
        }
    }

    /// (G1(v) - G2)/mu_v, the light that shadowing takes, with no cancellation where it is little;
    /// `lift` = s_l - mu_l.
    #[inline(always)]
    pub fn shadowed_over_cosine(self, mu_v: f64, s_v: f64, mu_l: f64, s_l: f64, lift: f64) -> f64 {
        let masking = 2.0 / (mu_v + s_v);
        match self {
            Smith::Correlated => masking * mu_v * lift / (s_v * mu_l + s_l * mu_v),
            Smith::Separable => masking * lift / (s_l + mu_l),
        }
    }
}
