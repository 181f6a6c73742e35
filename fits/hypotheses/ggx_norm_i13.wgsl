override c0: f32 = 0.0055601285;
override c1: f32 = -0.063161284;
override c2: f32 = 5.732871;
override c3: f32 = -0.060183655;
override c4: f32 = -7.040498;
override c5: f32 = 2.6156752;
override c6: f32 = 1.0489122;
override k: f32 = 1.9086473;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Thirteen operations. One reciprocal: mu and alpha times it depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness.
/// Exactly 1 for a mirror.
fn ggx_norm_i13(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let both = mu * alpha;
    let layer = inverse * (c2 + inverse * (c3 + c4 * mu + c5 * inverse));
    return 1.0 + alpha * (c0 + both * (c1 + layer + c6 * both));
}
