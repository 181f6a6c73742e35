override c0: f32 = 0.042775568;
override c1: f32 = 6.2075725;
override c2: f32 = -6.4765162;
override c3: f32 = -0.15298828;
override c4: f32 = 0.3218257;
override c5: f32 = -0.23956557;
override c6: f32 = 0.43075088;
override c7: f32 = -0.7508257;
override c8: f32 = 0.14841433;
override c9: f32 = -0.35179847;
override k0: f32 = 0.15214601;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Sixteen operations: a nested sum with a reciprocal.
fn ggx_glass_outside_16(alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let mu_inverse = mu * inverse;
    return 1.0 + alpha * (c0 + mu_inverse * (c1 + mu_inverse * (c2 + inverse * (c3 + mu_inverse * c4)) + alpha * (c5 + ior * (c6 + inverse * (c7 + ior * c8)) + mu * c9)));
}
