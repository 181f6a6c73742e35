override c0: f32 = 0.18433158;
override c1: f32 = -0.06409539;
override c2: f32 = 1.1175742;
override c3: f32 = -2.8219035;
override c4: f32 = 1.6761943;

/// Energy compensation of Beckmann's glass, for a view from outside: N = 1/(R + T).
/// Five operations: a polynomial.
fn beckmann_glass_outside_5(alpha: f32, mu: f32, ior: f32) -> f32 {
    return 1.0 + alpha * (c0 + c1 * ior + mu * (c2 + mu * (c3 + c4 * mu)));
}
