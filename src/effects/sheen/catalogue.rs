//! The hypotheses of this effect and the published formulas that they compete with.

use crate::approximate::{Entry, own, published};

/// E(alpha, mu) with free parameters, by rising cost.
pub const HYPOTHESES: [Entry; 9] = own![
    "charlie_e_8",
    "charlie_e_9",
    "charlie_e_10",
    "charlie_e_11",
    "charlie_e_13",
    "charlie_e_14",
    "charlie_e_15",
    "charlie_e_16",
    "charlie_e_exp",
];

/// The same with the shadowing of Estevez and Kulla.
pub const SHADOWED: [Entry; 6] = own![
    "estevez_kulla_e_8",
    "estevez_kulla_e_9",
    "estevez_kulla_e_11",
    "estevez_kulla_e_13",
    "estevez_kulla_e_14",
    "estevez_kulla_e_16",
];

/// E(roughness, mu) as engines ship it: measured and reported, not emitted.
pub const PUBLISHED: [Entry; 1] = published!["charlie_e_threejs" by "three.js, IBLSheenBRDF, 2025"];
