override c0: f32 = 0.1949293;
override c1: f32 = -0.015785074;
override c2: f32 = 0.7911874;
override c3: f32 = -0.9489538;

/// Energy compensation of glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Four operations: a polynomial.
fn ggx_glass_outside_flat_4(roughness: f32, alpha: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + alpha * (c1 + mu * (c2 + c3 * mu)));
}
