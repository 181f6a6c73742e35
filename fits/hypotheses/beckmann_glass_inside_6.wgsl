override c0: f32 = 7.1585264;
override c1: f32 = -7.3348236;
override c2: f32 = 1.6417512;
override c3: f32 = 0.6648061;
override c4: f32 = -6.478694;
override c5: f32 = 4.1429825;

/// Energy compensation of Beckmann's glass, for a view from inside: N = 1/(R + T).
/// Six operations: a polynomial.
fn beckmann_glass_inside_6(alpha: f32, mu: f32, ior: f32) -> f32 {
    return 1.0 + alpha * (c0 + ior * (c1 + c2 * ior) + alpha * (c3 + mu * (c4 + c5 * ior)));
}
