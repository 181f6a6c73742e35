override c0: f32 = -0.12724899;
override c1: f32 = -0.05946072;
override c2: f32 = 0.33598033;
override c3: f32 = 4.2249603;
override c4: f32 = -0.2746464;
override c5: f32 = 2.7404227;
override c6: f32 = -4.387159;
override c7: f32 = 6.194256;
override k: f32 = 1.7308568;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Thirteen operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i13(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    return 1.0 + alpha * (c0 + inverse * (c1 + alpha * (c2 + mu * (c3 + inverse * (c4 + inverse * c5)
        + mu * (c6 + alpha * c7)))));
}
