override c0: f32 = 0.3448341;
override c1: f32 = -0.49401632;
override c2: f32 = 3.8819768;
override c3: f32 = -17.092867;
override c4: f32 = 22.93706;
override c5: f32 = -10.389203;
override c6: f32 = 0.5322846;
override c7: f32 = -0.17725365;
override c8: f32 = 0.41361;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Nine operations: a polynomial.
fn ggx_glass_outside_9(roughness: f32, mu: f32, ior: f32) -> f32 {
    return 1.0 + roughness * (c0 + roughness * (c1 + mu * (c2 + mu * (c3 + mu * (c4 + c5 * mu))) + roughness * (c6 + ior * (c7 + c8 * mu))));
}
