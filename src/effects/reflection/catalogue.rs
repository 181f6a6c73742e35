//! The hypotheses of this effect and the published formulas that are emitted beside them; the
//! others stand in `published`.

use crate::approximate::{Entry, own, published};

/// N(alpha, mu) with free parameters, by rising cost.
pub const NORMALISATIONS: [Entry; 24] = own![
    "ggx_norm_r1",
    "ggx_norm_n2",
    "ggx_norm_r2",
    "ggx_norm_n1",
    "ggx_norm_r3p",
    "ggx_norm_r4",
    "ggx_norm_r4p",
    "ggx_norm_r5",
    "ggx_norm_r6",
    "ggx_norm_r8",
    "ggx_norm_i10",
    "ggx_norm_i11",
    "ggx_norm_i12",
    "ggx_norm_q13",
    "ggx_norm_i13",
    "ggx_norm_i14",
    "ggx_norm_i15",
    "ggx_norm_i15w",
    "ggx_norm_i16",
    "ggx_norm_i17",
    "ggx_norm_i18",
    "ggx_norm_i19",
    "ggx_norm_q20",
    "ggx_norm_i20",
];

/// E_avg(alpha) with free parameters.
pub const AVERAGES: [Entry; 5] = own!["ggx_eavg_3", "ggx_eavg_4", "ggx_eavg_5", "ggx_eavg_5p", "ggx_eavg_12"];

/// f0 A + B with free parameters, by rising cost.
pub const BLENDS: [Entry; 10] = own![
    "ggx_blend_11",
    "ggx_blend_14",
    "ggx_blend_16",
    "ggx_blend_21",
    "ggx_blend_22",
    "ggx_blend_24",
    "ggx_blend_24w",
    "ggx_blend_25",
    "ggx_blend_27",
    "ggx_blend_30",
];

/// The formulas of the source post, which started this: emitted beside ours.
pub const SEEDS: [Entry; 2] = published![
    "ggx_norm_pesce_n2" by "A. Pesce, Misunderstanding Multiscattering, 2019",
    "ggx_norm_pesce_n1" by "A. Pesce, Misunderstanding Multiscattering, 2019",
];

/// N(alpha, mu) of Beckmann's distribution with free parameters, by rising cost.
pub const BECKMANN_NORMALISATIONS: [Entry; 11] = own![
    "beckmann_norm_2",
    "beckmann_norm_3",
    "beckmann_norm_4",
    "beckmann_norm_6",
    "beckmann_norm_9",
    "beckmann_norm_12",
    "beckmann_norm_14",
    "beckmann_norm_15",
    "beckmann_norm_16",
    "beckmann_norm_18",
    "beckmann_norm_20",
];

/// f0 A + B of Beckmann's distribution with free parameters, by rising cost.
pub const BECKMANN_BLENDS: [Entry; 6] = own![
    "beckmann_blend_12",
    "beckmann_blend_14",
    "beckmann_blend_18",
    "beckmann_blend_21",
    "beckmann_blend_22",
    "beckmann_blend_24",
];
