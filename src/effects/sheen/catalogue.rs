//! The published formulas of this effect.

use crate::effects::entry::{Entry, published};

/// E(roughness, mu) as engines ship it: measured and reported, not emitted.
pub const RIVALS: [Entry; 1] = published!["charlie_e_threejs" by "three.js, IBLSheenBRDF, 2025"];
