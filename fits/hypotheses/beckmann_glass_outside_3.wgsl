override c0: f32 = 0.3660204;
override c1: f32 = -0.17370683;
override c2: f32 = -0.059868194;

/// Energy compensation of Beckmann's glass, for a view from outside: N = 1/(R + T).
/// Three operations: a polynomial.
fn beckmann_glass_outside_3(roughness: f32, mu: f32, ior: f32) -> f32 {
    return 1.0 + roughness * (c0 + c1 * ior + c2 * mu);
}
