override c0: f32 = -8.557643;
override c1: f32 = 76.80186;
override c2: f32 = -65.17658;
override d0: f32 = -18.193798;
override d1: f32 = 18.571323;
override d2: f32 = 15.270501;

/// What multiplies the reflection and the transmission of rough glass seen from inside: N = 1/(R + T).
/// Eleven operations: a quotient.
fn ggx_glass_inside_11(alpha: f32, mu: f32, ior: f32) -> f32 {
    let dividend = alpha * (c0 + alpha * (mu * (c1 + c2 * ior) + alpha));
    let divisor = d0 + d1 * ior + d2 * mu;
    return 1.0 - dividend / divisor;
}
