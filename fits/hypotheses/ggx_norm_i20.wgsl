override c0: f32 = 0.011590115;
override c1: f32 = 3.4644954;
override c2: f32 = 3.7216249;
override c3: f32 = -15.555857;
override c4: f32 = 10.098212;
override c5: f32 = -0.1991197;
override c6: f32 = -4.995408;
override c7: f32 = 0.13750301;
override c8: f32 = 0.41626638;
override c9: f32 = 17.232674;
override c10: f32 = 1.0302539;
override c11: f32 = 1.6302168;
override k: f32 = 0.8912573;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Twenty operations. One reciprocal: mu and alpha times it depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every
/// roughness. Exactly 1 for a mirror.
fn ggx_norm_i20(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let both = alpha * mu;
    let inverse = 1.0 / (mu + k * alpha);
    let facing = mu * inverse;
    let rough = alpha * inverse;
    let layer = c5 + c6 * both + rough * (c7 + mu * (c8 + c9 * both) + facing * (c10 + c11 * facing));
    return 1.0 + rough * (c0 + both * (c1 + mu * (c2 + roughness * (c3 + c4 * roughness))) + facing * layer);
}
