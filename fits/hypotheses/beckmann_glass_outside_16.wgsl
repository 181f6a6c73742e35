override c0: f32 = 0.001801683;
override c1: f32 = -0.46038222;
override c2: f32 = 0.36177814;
override c3: f32 = -0.29010049;
override c4: f32 = 0.36616266;
override c5: f32 = -0.20117806;
override c6: f32 = 1.753211;
override c7: f32 = -1.7103163;
override c8: f32 = 0.43557614;
override k0: f32 = 0.46678364;

/// Energy compensation of Beckmann's glass, for a view from outside: N = 1/(R + T).
/// Sixteen operations: a nested sum with a reciprocal.
fn beckmann_glass_outside_16(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    let alpha_inverse_alpha_inverse = alpha_inverse * alpha_inverse;
    return 1.0 + alpha_inverse_alpha_inverse * (c0 + mu * (c1 + inverse * (c2 + alpha_inverse * c5)
        + roughness * (c3 + ior * (c4 + alpha_inverse_alpha_inverse * (c7 + ior * c8))
        + alpha_inverse_alpha_inverse * c6)));
}
