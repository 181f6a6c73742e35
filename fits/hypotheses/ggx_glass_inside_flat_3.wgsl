override c0: f32 = 0.08798457;
override c1: f32 = 0.82691634;
override c2: f32 = 0.23760884;

/// Energy compensation of glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Three operations: a polynomial.
fn ggx_glass_inside_flat_3(roughness: f32, alpha: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + alpha * (c1 + c2 * mu));
}
