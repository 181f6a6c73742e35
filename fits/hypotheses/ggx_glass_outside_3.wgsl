override c0: f32 = 0.21500374;
override c1: f32 = 0.9765435;
override c2: f32 = -1.0923073;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Three operations: a polynomial.
fn ggx_glass_outside_3(alpha: f32, mu: f32) -> f32 {
    return 1.0 + alpha * (c0 + mu * (c1 + c2 * mu));
}
