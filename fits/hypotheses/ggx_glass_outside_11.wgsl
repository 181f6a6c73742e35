override c0: f32 = 0.7094361;
override c1: f32 = -3.0067234;
override c2: f32 = 5.2379837;
override c3: f32 = -31.457962;
override c4: f32 = 69.04616;
override c5: f32 = -68.11058;
override c6: f32 = 24.625584;
override c7: f32 = 4.9253726;
override c8: f32 = -0.22252621;
override c9: f32 = 0.49729213;
override c10: f32 = -2.2343915;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Eleven operations: a polynomial.
fn ggx_glass_outside_11(roughness: f32, mu: f32, ior: f32) -> f32 {
    return 1.0 + roughness * (c0 + roughness * (c1 + mu * (c2 + mu * (c3 + mu * (c4 + mu * (c5 + c6 * mu))))
        + roughness * (c7 + ior * (c8 + c9 * mu) + c10 * roughness)));
}
