override c0: f32 = -0.32975695;
override c1: f32 = -2.0795858;
override c2: f32 = 5.6639857;
override c3: f32 = 0.315373;
override c4: f32 = 14.772396;
override c5: f32 = 11.98678;
override c6: f32 = -10.902246;
override k: f32 = 2.1289394;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Fourteen operations. One reciprocal: mu and alpha times it depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness.
/// Exactly 1 for a mirror.
fn ggx_norm_i14(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let both = alpha * mu;
    let ratio = alpha * inverse;
    let square = c2 + c3 * alpha + both * (c4 + c5 * both) + c6 * ratio;
    return 1.0 + ratio * (c0 + c1 * both + ratio * square);
}
