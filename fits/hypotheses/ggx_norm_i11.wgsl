override c0: f32 = -0.4905267;
override c1: f32 = 0.024177125;
override c2: f32 = 2.5990129;
override c3: f32 = 1.9549197;
override c4: f32 = 0.31003374;
override k: f32 = 0.7778345;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Eleven operations. One reciprocal: mu and alpha times it depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every
/// roughness. Exactly 1 for a mirror.
fn ggx_norm_i11(alpha: f32, mu: f32) -> f32 {
    let both = alpha * mu;
    let inverse = 1.0 / (mu + k * alpha);
    return 1.0 + both * (c0 + inverse * (c1 + alpha * (c2 + c3 * both) + c4 * inverse));
}
