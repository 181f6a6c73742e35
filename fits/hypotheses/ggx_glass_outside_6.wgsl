override c0: f32 = 0.21836568;
override c1: f32 = -0.038127776;
override c2: f32 = 3.2796798;
override c3: f32 = -8.29104;
override c4: f32 = 0.28755787;
override c5: f32 = 4.556562;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Six operations: a polynomial.
fn ggx_glass_outside_6(alpha: f32, mu: f32, ior: f32) -> f32 {
    return 1.0 + alpha * (c0 + c1 * ior + mu * (c2 + mu * (c3 + c4 * ior + c5 * mu)));
}
