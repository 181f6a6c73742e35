override c0: f32 = 3.768572;
override c1: f32 = -1.6134046;
override c2: f32 = -4.7166524;
override c3: f32 = 2.7445803;

/// What multiplies the reflection and the transmission of rough glass seen from inside: N = 1/(R + T).
/// Four operations: a polynomial.
fn ggx_glass_inside_4(alpha: f32, mu: f32, ior: f32) -> f32 {
    return 1.0 + alpha * (c0 + c1 * ior + mu * (c2 + c3 * ior));
}
