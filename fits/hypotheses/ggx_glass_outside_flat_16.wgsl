override c0: f32 = -0.029803272;
override c1: f32 = 0.058878064;
override c2: f32 = 0.7685768;
override c3: f32 = -0.6534252;
override c4: f32 = 0.23434317;
override c5: f32 = -1.8663484;
override c6: f32 = 1.2836603;
override c7: f32 = -1.3448447;
override c8: f32 = 2.6247432;
override c9: f32 = -1.1746811;
override k: f32 = 0.6074111;

/// Energy compensation of glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Sixteen operations: a nested sum with a reciprocal.
fn ggx_glass_outside_flat_16(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    return 1.0 + ratio * (c0 + alpha * (c1 + mu * (c2 + inverse * (c3 + inverse * (c4 + mu * (c5 + inverse * (c6
        + ratio * c9)))) + roughness * (c7 + inverse * c8))));
}
