override c0: f32 = 0.14082676;
override c1: f32 = -0.03996604;
override c2: f32 = -0.18766369;
override c3: f32 = 0.16704059;
override k0: f32 = 0.40830562;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Nine operations: a nested sum with a reciprocal.
fn beckmann_glass_outside_flat_9(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    return 1.0 + alpha * (c0 + inverse * (c1 + mu * (c2 + inverse * c3)));
}
