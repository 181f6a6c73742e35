//! What the channels of a table mean.

use super::{Layout, Serves};

/// What a lookup returns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Values {
    /// Directional albedo.
    pub e: f32,
    /// Schlick's bias, where the table holds it: the albedo at a reflectance f0 is f0 (e - b) + b.
    pub b: Option<f32>,
}

/// How values follow from the channels of a texel. Another meaning is another variant: its
/// channels, its formula for headers, and its function in `decodings.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Decode {
    /// `E`: the directional albedo.
    Albedo,
    /// `loss`: 1 - E.
    Loss,
    /// `A`, `B`: scale and bias of Schlick's F0; E = A + B.
    SplitSum,
    /// `c0`, `c1`, `c2`, `c3`: with q = 1 - 0.9 anisotropy and
    /// (alpha_v/alpha)^2 = cos2_phi/q + (1 - cos2_phi) q, the alpha towards the view,
    /// t = log((alpha_v/alpha)^2)/-log(q) in [-1, 1] and E = 1 - (c0 + t (c1 + t (c2 + t c3))).
    AzimuthCubic,
    /// `deficit`: R = (1 - deficit) F, F the reflectance of a smooth surface at mu and ior (Fresnel).
    Deficit,
    /// `loss`, `bias`: E = 1 - loss, B = E (bias + (1 - mu)^5).
    LossBias,
    /// `m11`, `m31`, `m13`, `m33`: the inverse matrix of a linearly transformed cosine, whose m22 is 1.
    Transform,
    /// `E`, `B`, `zero`, `sphere`: what the shares of lights are scaled by, and the share of a sphere
    /// over the cosine of its direction, 2 u - 1, and the length v of its vector form factor.
    Light,
}

impl Decode {
    /// The decoding of a table; with a third axis it serves the albedo.
    pub fn of(layout: Layout, serves: Serves) -> Decode {
        match (layout, serves) {
            (Layout::Homogeneous, Serves::Albedo) => Decode::Loss,
            (Layout::Homogeneous, Serves::SplitSum) => Decode::LossBias,
            (Layout::Plain | Layout::PlainSquared, Serves::Albedo) => Decode::Albedo,
            (Layout::Plain | Layout::PlainSquared, Serves::SplitSum) => Decode::SplitSum,
            (Layout::Optimised | Layout::FiveAxis, _) => Decode::Loss,
            (Layout::PathTracer, _) => Decode::Albedo,
            (Layout::Azimuth, _) => Decode::AzimuthCubic,
            (Layout::AreaLights, _) => Decode::Transform,
            (Layout::Dielectric, _) => Decode::Deficit,
        }
    }

    /// Every decoding, in the order of the declaration.
    pub const ALL: [Decode; 8] = [
        Decode::Albedo,
        Decode::Loss,
        Decode::SplitSum,
        Decode::AzimuthCubic,
        Decode::Deficit,
        Decode::LossBias,
        Decode::Transform,
        Decode::Light,
    ];

    /// Its function in `decodings.wgsl`.
    pub(super) fn function(self) -> &'static str {
        match self {
            Decode::Albedo => "albedo",
            Decode::Loss => "loss",
            Decode::SplitSum => "split_sum",
            Decode::AzimuthCubic => "azimuth_cubic",
            Decode::Deficit => "deficit",
            Decode::LossBias => "loss_bias",
            Decode::Transform | Decode::Light => "whole",
        }
    }

    /// Number of values of the decoding: E, or E, A and B.
    pub fn count(self) -> usize {
        self.formulas().len()
    }

    /// Channels of a texel: those that the variant names, in this order.
    pub fn channels(self) -> usize {
        match self {
            Decode::Albedo | Decode::Loss | Decode::Deficit => 1,
            Decode::SplitSum | Decode::LossBias => 2,
            Decode::AzimuthCubic | Decode::Transform | Decode::Light => 4,
        }
    }

    /// What a lookup returns, in words.
    pub fn meaning(self) -> &'static str {
        match self {
            Decode::Transform => "The texel m11, m31, m13, m33 of M^-1",
            Decode::Light => {
                "E, B, 0 and, at u = (cosine + 1)/2 and v = length of a vector form factor, the share of a sphere divided by that length"
            }
            Decode::SplitSum | Decode::LossBias => "E, A and B",
            Decode::Albedo | Decode::Loss | Decode::AzimuthCubic => "E",
            Decode::Deficit => "R",
        }
    }

    /// Whether a texel tells B beside E.
    pub fn has_bias(self) -> bool {
        matches!(self, Decode::SplitSum | Decode::LossBias)
    }

    /// The values and their formulas, as written in headers and the manifest.
    pub fn formulas(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Decode::Albedo => &[("E", "E")],
            Decode::Loss => &[("E", "1 - loss")],
            Decode::Deficit => &[(
                "R",
                "(1 - deficit) * a^2 * (1 + b^2) / 2, g = sqrt(ior^2 - 1 + mu^2), a = (g - mu) / (g + mu), \
                 b = (mu * (g + mu) - 1) / (mu * (g - mu) + 1)",
            )],
            Decode::AzimuthCubic => &[(
                "E",
                "1 - (c0 + t * (c1 + t * (c2 + t * c3))), t = log2(cos2_phi / q + (1 - cos2_phi) * q) / -log2(q), \
                 q = 1 - 0.9 * anisotropy (t = 0 at anisotropy 0)",
            )],
            Decode::SplitSum => &[("E", "A + B"), ("B", "B"), ("A", "A")],
            Decode::Transform => &[("m11", "m11"), ("m31", "m31"), ("m13", "m13"), ("m33", "m33")],
            Decode::Light => &[("E", "E"), ("B", "B"), ("zero", "zero"), ("sphere", "sphere")],
            Decode::LossBias => &[("E", "1 - loss"), ("B", "E * (bias + (1 - mu)^5)"), ("A", "E - B")],
        }
    }
}
