//! What the channels of a table mean.

use super::{Layout, Serves, Surface};
use lobefit_math::ops;

/// What a lookup returns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Values {
    /// Directional albedo.
    pub e: f32,
    /// Schlick's bias, where the table holds it: the albedo at a reflectance f0 is f0 (e - b) + b.
    pub b: Option<f32>,
}

/// How values follow from the channels of a texel. Another meaning is another variant: its channels, its formula, its f32
/// arithmetic here and the lines that the emitted code has for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Decode {
    /// `E`: the directional albedo.
    Albedo,
    /// `loss`: 1 - E.
    Loss,
    /// `A`, `B`: scale and bias of Schlick's F0; E = A + B.
    SplitSum,
    /// `c0`, `c1`, `c2`, `c3`: with q = 1 - 0.9 anisotropy and (alpha_v/alpha)^2 = cos2_phi/q + (1 - cos2_phi) q, the alpha towards the view,
    /// t = log((alpha_v/alpha)^2)/-log(q) in [-1, 1] and E = 1 - (c0 + t (c1 + t (c2 + t c3))).
    AzimuthCubic,
    /// `loss`, `bias`: E = 1 - loss, B = E (bias + (1 - mu)^5).
    LossBias,
}

impl Decode {
    /// The decoding of a table; with a third axis it serves the albedo.
    pub fn of(layout: Layout, serves: Serves) -> Decode {
        match (layout, serves) {
            (Layout::Homogeneous, Serves::Albedo) => Decode::Loss,
            (Layout::Homogeneous, Serves::SplitSum) => Decode::LossBias,
            (Layout::Plain | Layout::PlainSquared, Serves::Albedo) => Decode::Albedo,
            (Layout::Plain | Layout::PlainSquared, Serves::SplitSum) => Decode::SplitSum,
            (Layout::Optimised, _) => Decode::Loss,
            (Layout::PathTracer, _) => Decode::Albedo,
            (Layout::Azimuth, _) => Decode::AzimuthCubic,
        }
    }

    /// Operations of the decoding by the model of [`Cost`](super::Cost), what it shares with the coordinates counted there.
    ///
    /// `AzimuthCubic`: two log2 8, max 1, division 5, three fma, 1 - x. `LossBias`: see its formula.
    pub fn ops(self) -> u32 {
        match self {
            Decode::Albedo => 0,
            Decode::Loss | Decode::SplitSum => 1,
            Decode::LossBias => 7,
            Decode::AzimuthCubic => 18,
        }
    }

    /// Channels of a texel: those that the variant names, in this order.
    pub fn channels(self) -> usize {
        match self {
            Decode::Albedo | Decode::Loss => 1,
            Decode::SplitSum | Decode::LossBias => 2,
            Decode::AzimuthCubic => 4,
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
            Decode::AzimuthCubic => &[(
                "E",
                "1 - (c0 + t * (c1 + t * (c2 + t * c3))), t = log2(cos2_phi / q + (1 - cos2_phi) * q) / -log2(q), \
                 q = 1 - 0.9 * anisotropy (t = 0 at anisotropy 0)",
            )],
            Decode::SplitSum => &[("E", "A + B"), ("B", "B"), ("A", "A")],
            Decode::LossBias => &[("E", "1 - loss"), ("B", "E * (bias + (1 - mu)^5)"), ("A", "E - B")],
        }
    }

    /// The values of a texel in a shader's arithmetic; what lies beyond the table's channels is not read.
    pub fn values(self, texel: [f32; 4], mu: f32, surface: Surface<f32>) -> Values {
        match self {
            Decode::Albedo => Values { e: texel[0], b: None },
            Decode::Loss => Values { e: 1.0 - texel[0], b: None },
            Decode::LossBias => {
                let (e, x) = (1.0 - texel[0], 1.0 - mu);
                let x2 = x * x;
                Values { e, b: Some(e * (texel[1] + x2 * x2 * x)) }
            }
            Decode::AzimuthCubic => {
                let [c0, c1, c2, c3] = texel;
                let t = ops::log2f(surface.spread()) / (-ops::log2f(surface.squash())).max(1e-6);
                Values { e: 1.0 - (c0 + t * (c1 + t * (c2 + t * c3))), b: None }
            }
            Decode::SplitSum => Values { e: texel[0] + texel[1], b: Some(texel[1]) },
        }
    }
}
