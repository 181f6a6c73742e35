override c0: f32 = 0.07812368;
override c1: f32 = -0.20442295;
override c2: f32 = 0.116509475;
override c3: f32 = 0.14651892;
override c4: f32 = 0.0011347724;
override c5: f32 = -0.2574134;
override c6: f32 = -0.081381366;
override c7: f32 = 0.9712408;
override c8: f32 = -0.8950639;
override c9: f32 = 0.22535227;
override c10: f32 = 0.18579635;
override k: f32 = 0.26131597;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Sixteen operations: a nested sum with a reciprocal.
fn ggx_glass_outside_16(alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    return 1.0 + alpha * (c0 + mu * (c1 + inverse * (c2 + inverse * (c3 + inverse * (c4 + alpha * (c6 + alpha
        * (c7 + ior * (c8 + ior * (c9 + mu * c10)))))) + alpha * c5)));
}
