override c0: f32 = 0.9020905;
override c1: f32 = -0.8953652;
override c2: f32 = 0.21279377;
override c3: f32 = -0.67223215;
override c4: f32 = 1.987653;
override c5: f32 = -0.15116031;
override c6: f32 = 0.45364198;
override c7: f32 = -2.3736742;
override c8: f32 = 0.2992008;
override k: f32 = 0.1933039;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Fourteen operations: a nested sum with a reciprocal.
fn ggx_glass_outside_14(alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    return 1.0 + alpha * (c0 + ior * (c1 + ior * c2) + mu * (c3 + inverse * (c4 + inverse * (c5 + mu * (c7
        + inverse * c8))) + ior * c6));
}
