override c0: f32 = -0.3221413;
override c1: f32 = -0.11158523;
override c2: f32 = 0.0899428;
override c3: f32 = 0.13565579;
override c4: f32 = 0.35674798;
override k0: f32 = 0.41747886;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Ten operations: a nested sum with a reciprocal.
fn beckmann_glass_outside_flat_10(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    return 1.0 + alpha * (c0 + mu * (c1 + inverse * (c2 + inverse * c3)) + roughness * c4);
}
