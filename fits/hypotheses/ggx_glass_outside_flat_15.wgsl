override c0: f32 = -0.09700524;
override c1: f32 = 1.5284953;
override c2: f32 = -8.101765;
override c3: f32 = 6.2800493;
override c4: f32 = 2.096623;
override c5: f32 = -2.071306;
override c6: f32 = 0.14727406;
override c7: f32 = -0.65412575;
override c8: f32 = 2.0389721;
override k: f32 = 0.61071044;

/// Energy compensation of glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Fifteen operations: a nested sum with a reciprocal.
fn ggx_glass_outside_flat_15(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = mu * inverse;
    return 1.0 + alpha * (c0 + ratio * (c1 + ratio * (c2 + ratio * (c3 + inverse * (c4 + ratio * c5))))
        + roughness * (c6 + mu * c7 + ratio * c8));
}
