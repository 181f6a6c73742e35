override c0: f32 = -0.016366998;
override c1: f32 = 0.030983288;
override c2: f32 = 0.210791;
override c3: f32 = -3.0270257;
override c4: f32 = 7.2774177;
override c5: f32 = 0.26931888;
override c6: f32 = 11.353574;
override c7: f32 = 4.189522;
override c8: f32 = 11.979942;
override c9: f32 = -4.3944206;
override c10: f32 = -26.119389;
override c11: f32 = -17.375349;
override c12: f32 = 6.279634;
override c13: f32 = 15.798846;
override k: f32 = 1.1455376;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Twenty operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i20(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    return 1.0 + roughness * c0 + alpha * (c1 + mu * (c2 + ratio * (c3 + ratio * (c4 + inverse * (c5
        + inverse * (c6 + ratio * (c10 + ratio * c13)) + mu * (c8 + ratio * c11)) + mu * (c7
        + mu * (c9 + alpha * c12))))));
}
