override c0: f32 = -0.27750137;
override c1: f32 = 4.046281;
override c2: f32 = 0.30633616;
override c3: f32 = -8.681339;
override c4: f32 = 4.6487184;
override c5: f32 = -1.9780147;
override c6: f32 = -2.657504;
override c7: f32 = 5.107331;
override c8: f32 = 21.915318;
override k: f32 = 1.2003565;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Fifteen operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i15(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    return 1.0 + ratio * (c0 + ratio * (c1 + mu * (c2 + alpha * (c4 + mu * (c5 + mu * (c6
        + ratio * c8)))) + ratio * (c3 + ratio * c7)));
}
