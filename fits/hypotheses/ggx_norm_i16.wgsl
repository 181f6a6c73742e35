override c0: f32 = 0.025063789;
override c1: f32 = -1.3510519;
override c2: f32 = 0.111066096;
override c3: f32 = 9.951887;
override c4: f32 = 7.925465;
override c5: f32 = 11.611271;
override c6: f32 = -31.817593;
override c7: f32 = 14.527826;
override c8: f32 = 73.28637;
override k: f32 = 1.5751143;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Sixteen operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i16(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    let facing = mu * ratio;
    return 1.0 + ratio * (c0 + facing * (c1 + inverse * (c2 + facing * (c4 + inverse * c5))
        + alpha * (c3 + facing * (c6 + roughness * c7 + facing * c8))));
}
