//! What the channels of a table mean.

use super::{Layout, Serves};

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
    /// `loss`, `bias`: E = 1 - loss, B = E (bias + (1 - mu)^5).
    LossBias,
}

impl Decode {
    /// The decoding of a table of isotropic reflection.
    pub fn of(layout: Layout, serves: Serves) -> Decode {
        match (layout, serves) {
            (Layout::Homogeneous, Serves::Albedo) => Decode::Loss,
            (Layout::Homogeneous, Serves::SplitSum) => Decode::LossBias,
            (_, Serves::Albedo) => Decode::Albedo,
            (_, Serves::SplitSum) => Decode::SplitSum,
        }
    }

    /// Channels of a texel: those that the variant names, in this order.
    pub fn channels(self) -> usize {
        match self {
            Decode::Albedo | Decode::Loss => 1,
            Decode::SplitSum | Decode::LossBias => 2,
        }
    }

    /// The values and their formulas, as written in headers and the manifest.
    pub fn formulas(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Decode::Albedo => &[("E", "E")],
            Decode::Loss => &[("E", "1 - loss")],
            Decode::SplitSum => &[("E", "A + B"), ("B", "B"), ("A", "A")],
            Decode::LossBias => &[("E", "1 - loss"), ("B", "E * (bias + (1 - mu)^5)"), ("A", "E - B")],
        }
    }

    /// E of a texel in a shader's arithmetic; what lies beyond the table's channels is not read.
    pub fn albedo(self, texel: [f32; 4]) -> f32 {
        match self {
            Decode::Albedo => texel[0],
            Decode::Loss | Decode::LossBias => 1.0 - texel[0],
            Decode::SplitSum => texel[0] + texel[1],
        }
    }
}
