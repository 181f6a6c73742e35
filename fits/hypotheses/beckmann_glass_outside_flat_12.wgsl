override c0: f32 = 0.20068465;
override c1: f32 = 0.1401507;
override c2: f32 = -0.19800422;
override c3: f32 = 0.3044521;
override c4: f32 = -1.6074467;
override c5: f32 = 0.5409344;
override k0: f32 = 0.621995;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Twelve operations: a nested sum with a reciprocal.
fn beckmann_glass_outside_flat_12(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let mu_inverse = mu * inverse;
    return 1.0 + alpha * (c0 + alpha * (c1 + inverse * (c2 + mu_inverse * (c3 + mu_inverse * (c4
        + inverse * c5)))));
}
