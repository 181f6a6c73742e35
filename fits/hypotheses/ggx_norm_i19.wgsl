override c0: f32 = 0.12509415;
override c1: f32 = -2.222523;
override c2: f32 = 0.026473138;
override c3: f32 = 24.59167;
override c4: f32 = 4.966203;
override c5: f32 = 4.2450266;
override c6: f32 = -4.811314;
override c7: f32 = -73.17521;
override c8: f32 = 6.93302;
override c9: f32 = 84.62915;
override c10: f32 = -34.439953;
override c11: f32 = 0.5878397;
override c12: f32 = -16.38674;
override k: f32 = 1.240717;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Nineteen operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i19(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    return 1.0 + ratio * (c0 + ratio * (c1 + alpha * (c2 + mu * (c4 + mu * (c5 + mu * (c6 + alpha * c8))))
        + ratio * (c3 + ratio * (c7 + ratio * (c9 + ratio * (c10 + mu * (c11 + mu * c12)))))));
}
