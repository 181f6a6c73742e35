override c0: f32 = -0.017748171;
override c1: f32 = -1.1503569;
override c2: f32 = 2.866415;
override c3: f32 = 0.7953118;
override c4: f32 = 0.23230751;
override k: f32 = 0.655294;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Ten operations. One reciprocal: mu and alpha times it depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness.
/// Exactly 1 for a mirror.
fn ggx_norm_i10(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let layer = inverse * (c3 + c4 * inverse);
    return 1.0 + alpha * (c0 + mu * (c1 + c2 * alpha + layer));
}
