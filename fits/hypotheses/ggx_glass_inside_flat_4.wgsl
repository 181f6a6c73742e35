override c0: f32 = 0.41267133;
override c1: f32 = -0.49597898;
override c2: f32 = 0.37562704;
override c3: f32 = 0.99602246;

/// Energy compensation of glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Four operations: a polynomial.
fn ggx_glass_inside_flat_4(roughness: f32, alpha: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + c1 * mu + alpha * (c2 + c3 * mu));
}
