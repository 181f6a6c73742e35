override c0: f32 = 0.117463924;
override c1: f32 = 0.013938144;
override c2: f32 = 4.350951;
override c3: f32 = -15.697963;
override c4: f32 = 19.454304;
override c5: f32 = -8.141965;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Six operations: a polynomial.
fn ggx_glass_outside_6(roughness: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + roughness * (c1 + mu * (c2 + mu * (c3 + mu * (c4 + c5 * mu)))));
}
