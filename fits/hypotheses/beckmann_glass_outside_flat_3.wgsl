override c0: f32 = 0.49471748;
override c1: f32 = -1.28724;
override c2: f32 = 0.8683213;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Three operations: a polynomial.
fn beckmann_glass_outside_flat_3(roughness: f32) -> f32 {
    return 1.0 + roughness * (c0 + roughness * (c1 + c2 * roughness));
}
