//! What engines ship for this effect: measured and reported beside ours, not emitted.
//! `tests/effects/published.rs` reproduces their published comparison.

use crate::approximate::{Entry, published};

/// N(alpha, mu), as N = 1/E where the publication gives E.
pub const PUBLISHED: [Entry; 12] = published![
    "ggx_norm_urp" by "Unity URP, EnvironmentBRDFSpecular",
    "ggx_norm_lazarov" by "D. Lazarov, Getting More Physical in Black Ops II, 2013",
    "ggx_norm_narkowicz_l2" by "K. Narkowicz, Analytical DFG Term for IBL, 2014, after Lazarov",
    "ggx_norm_turquin_label" by "WGSL engines, labelled Turquin 2019",
    "ggx_norm_dassault" by "Dassault Systemes, Enterprise PBR Shading Model",
    "ggx_norm_karis" by "B. Karis, Physically Based Shading on Mobile, 2014",
    "ggx_norm_narkowicz_p1" by "K. Narkowicz, Analytical DFG Term for IBL, 2014",
    "ggx_norm_pesce_iwanicki" by "Pesce and Iwanicki, Approximate Models for PBR, 2015",
    "ggx_norm_tauray" by "VGA group, Tauray",
    "ggx_norm_ue5" by "Unreal Engine 5, ShadingEnergyConservation",
    "ggx_norm_ray_tracing_gems" by "Ray Tracing Gems, ch. 32, 2019, for separable Smith",
    "ggx_norm_materialx_m1" by "MaterialX, mx_microfacet_specular",
];

/// f0 A + B of the split sum: B at f0 = 0, E at f0 = 1.
pub const PUBLISHED_BLENDS: [Entry; 12] = published![
    "ggx_blend_schlick_roughness" by "S. Lagarde; C. Fdez-Aguera 2019; LearnOpenGL",
    "ggx_blend_urp" by "Unity URP, EnvironmentBRDFSpecular",
    "ggx_blend_lazarov" by "D. Lazarov, Getting More Physical in Black Ops II, 2013",
    "ggx_blend_karis" by "B. Karis, Physically Based Shading on Mobile, 2014",
    "ggx_blend_narkowicz_l2" by "K. Narkowicz, Analytical DFG Term for IBL, 2014, after Lazarov",
    "ggx_blend_pesce_iwanicki" by "Pesce and Iwanicki, Approximate Models for PBR, 2015",
    "ggx_blend_narkowicz_p1" by "K. Narkowicz, Analytical DFG Term for IBL, 2014",
    "ggx_blend_ross" by "NVIDIA MathLib and NRD, EnvironmentTerm_Ross",
    "ggx_blend_tauray" by "VGA group, Tauray",
    "ggx_blend_ray_tracing_gems" by "Ray Tracing Gems, ch. 32, 2019, for separable Smith",
    "ggx_blend_ue5" by "Unreal Engine 5, ShadingEnergyConservation",
    "ggx_blend_materialx_m1" by "MaterialX, mx_microfacet_specular",
];

/// E_avg(alpha).
pub const PUBLISHED_AVERAGES: [Entry; 3] = published![
    "ggx_eavg_dassault" by "Dassault Systemes, Enterprise PBR Shading Model",
    "ggx_eavg_chebyshev" by "a path tracer in Mojo",
    "ggx_eavg_cycles" by "Cycles up to 3.4, mf_ggx_albedo",
];
