override d0: f32 = -1.7121631;
override d1: f32 = 1.8279619;
override d2: f32 = 13.696597;
override d3: f32 = -13.949195;
override d4: f32 = 3.5425096;
override d5: f32 = -0.3597918;

/// What multiplies the reflection and the transmission of rough glass seen from inside: N = 1/(R + T).
/// Ten operations: a quotient.
fn ggx_glass_inside_10(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let divisor = d0 + d1 * ior + mu * (d2 + ior * (d3 + ior * (d4 + d5 * roughness)));
    return 1.0 + alpha / divisor;
}
