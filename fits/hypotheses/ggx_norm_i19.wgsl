override c0: f32 = 0.016099466;
override c1: f32 = 4.0101767;
override c2: f32 = 3.9497852;
override c3: f32 = -18.18901;
override c4: f32 = 12.401366;
override c5: f32 = -0.19971113;
override c6: f32 = -5.452953;
override c7: f32 = 0.04709584;
override c8: f32 = 0.16189492;
override c9: f32 = 20.686096;
override c10: f32 = 2.7894268;
override k: f32 = 1.0618441;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Nineteen operations. One reciprocal: mu and alpha times it depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every
/// roughness. Exactly 1 for a mirror.
fn ggx_norm_i19(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let both = alpha * mu;
    let inverse = 1.0 / (mu + k * alpha);
    let facing = mu * inverse;
    let rough = alpha * inverse;
    let layer = c5 + c6 * both + rough * (c7 + mu * (c8 + c9 * both) + c10 * facing);
    return 1.0 + rough * (c0 + both * (c1 + mu * (c2 + roughness * (c3 + c4 * roughness))) + facing * layer);
}
