override c0: f32 = -0.34261984;
override c1: f32 = 0.25350636;
override c2: f32 = 2.69519;
override c3: f32 = -0.25232625;
override c4: f32 = 0.00062055;
override c5: f32 = -3.2771885;
override c6: f32 = 1.8195926;
override c7: f32 = -0.36193228;
override c8: f32 = -0.9921221;
override c9: f32 = 0.5832691;
override c10: f32 = 0.05329987;
override c11: f32 = -0.09299366;
override c12: f32 = 0.026903417;
override k: f32 = 0.3121118;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Eighteen operations: a nested sum with a reciprocal.
fn ggx_glass_outside_18(alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    return 1.0 + alpha * (c0 + inverse * (c1 + alpha * (c2 + inverse * (c3 + inverse * (c4 + alpha * (c10
        + alpha * (c11 + ior * c12)))) + ior * (c5 + ior * (c6 + ior * c7)) + mu * (c8 + ior * c9))));
}
