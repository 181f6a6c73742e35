override c0: f32 = -0.42208534;
override c1: f32 = 6.227857;
override c2: f32 = 0.26572824;
override c3: f32 = -11.964309;
override c4: f32 = 12.165692;
override c5: f32 = -7.986682;
override c6: f32 = 15.026869;
override c7: f32 = 2.2315078;
override k: f32 = 2.2024906;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Fourteen operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i14(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    return 1.0 + ratio * (c0 + ratio * (c1 + alpha * (c2 + mu * (c4 + mu * (c5 + alpha * (c6
        + mu * c7)))) + ratio * c3));
}
