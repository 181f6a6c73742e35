override c0: f32 = 0.021448826;
override c1: f32 = 2.213064;
override c2: f32 = 1.3032373;
override c3: f32 = -2.5156178;
override c4: f32 = 6.2731295;
override c5: f32 = -2.9822626;
override c6: f32 = -0.23043598;
override c7: f32 = 0.061560243;
override c8: f32 = 2.6599593;
override k: f32 = 1.0268384;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Seventeen operations. One reciprocal: mu and alpha times it depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every
/// roughness. Exactly 1 for a mirror.
fn ggx_norm_i17(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let both = alpha * mu;
    let inverse = 1.0 / (mu + k * alpha);
    let facing = mu * inverse;
    let rough = alpha * inverse;
    let layer = c6 + rough * (c7 + c8 * facing);
    return 1.0 + rough * (c0 + both * (c1 + c2 * roughness + mu * (c3 + both * (c4 + c5 * mu))) + facing * layer);
}
