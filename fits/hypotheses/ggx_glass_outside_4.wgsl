override c0: f32 = 0.15768372;
override c1: f32 = 3.1663086;
override c2: f32 = -7.1028357;
override c3: f32 = 3.9216368;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Four operations: a polynomial.
fn ggx_glass_outside_4(alpha: f32, mu: f32) -> f32 {
    return 1.0 + alpha * (c0 + mu * (c1 + mu * (c2 + c3 * mu)));
}
