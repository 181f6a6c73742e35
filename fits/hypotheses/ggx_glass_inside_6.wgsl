override c0: f32 = 5.3405457;
override c1: f32 = -3.4465814;
override c2: f32 = 0.5133429;
override c3: f32 = -5.456057;
override c4: f32 = 2.424344;
override c5: f32 = 1.2369084;

/// What multiplies the reflection and the transmission of rough glass seen from inside: N = 1/(R + T).
/// Six operations: a polynomial.
fn ggx_glass_inside_6(alpha: f32, mu: f32, ior: f32) -> f32 {
    return 1.0 + alpha * (c0 + ior * (c1 + c2 * ior) + mu * (c3 + c4 * ior + c5 * mu));
}
