//! What reading a table costs.

use crate::data::{Layout, Serves};

/// Operations of a lookup beside its fetch, coordinates and decoding, to E, or to E, A and B.
///
/// Homogeneous coordinate: 1 + alpha, times mu, mu + alpha, rcp 4, mul, sqrt 4 are 12; one fma per axis to the texture
/// coordinate. Decoding: 1 - loss; x = 1 - mu, x^2, x^4, fma with the bias, times E, A = E - B are 6. Plain: the coordinates are the
/// inputs, or sqrt(mu); E = A + B.
pub fn lookup_ops(layout: Layout, serves: Serves) -> u32 {
    match (layout, serves) {
        (Layout::Homogeneous, Serves::Albedo) => 12 + 2 + 1,
        (Layout::Homogeneous, Serves::SplitSum) => 12 + 2 + 1 + 6,
        (Layout::Plain, Serves::Albedo) => 0,
        (Layout::Plain, Serves::SplitSum) => 1,
        (Layout::PlainSquared, Serves::Albedo) => 4,
        (Layout::PlainSquared, Serves::SplitSum) => 5,
    }
}
