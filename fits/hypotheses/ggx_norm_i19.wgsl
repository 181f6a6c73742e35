override c0: f32 = 0.013103205;
override c1: f32 = 0.18179342;
override c2: f32 = -4.1666236;
override c3: f32 = 9.837755;
override c4: f32 = -0.14533311;
override c5: f32 = 0.51707375;
override c6: f32 = 0.9814702;
override c7: f32 = 17.163475;
override c8: f32 = 16.005604;
override c9: f32 = -0.04666852;
override c10: f32 = 11.270033;
override c11: f32 = -51.31127;
override c12: f32 = 45.40256;
override k: f32 = 1.2053783;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Nineteen operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i19(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    return 1.0 + alpha * (c0 + mu * (c1 + ratio * (c2 + ratio * (c3 + inverse * (c4 + inverse * c5
        + mu * (c6 + mu * (c7 + inverse * (c8 + inverse * (c9 + inverse * c10)) + roughness * c11
        + alpha * c12)))))));
}
