override c0: f32 = -0.20674849;
override c1: f32 = 1.6205934;
override c2: f32 = -1.1140893;
override c3: f32 = -1.8140776;
override c4: f32 = -1.094377;
override c5: f32 = 0.69778657;
override c6: f32 = 1.4956034;
override k0: f32 = 0.76446414;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Thirteen operations: a nested sum with a reciprocal.
fn beckmann_glass_outside_flat_13(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    return 1.0 + alpha_inverse * (c0 + alpha_inverse * (c1 + alpha_inverse * (c2 + mu * (c3
        + inverse * c4 + alpha * c5 + alpha_inverse * c6))));
}
