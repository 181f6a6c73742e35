override c0: f32 = 0.19557904;
override c1: f32 = 0.5598407;
override c2: f32 = -0.74854606;

/// Energy compensation of glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Three operations: a polynomial.
fn ggx_glass_outside_flat_3(roughness: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + mu * (c1 + c2 * mu));
}
