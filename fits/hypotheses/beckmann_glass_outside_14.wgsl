override c0: f32 = 0.11320772;
override c1: f32 = -0.04113254;
override c2: f32 = -0.822353;
override c3: f32 = 0.41248965;
override c4: f32 = 1.104812;
override c5: f32 = -1.4152095;
override c6: f32 = 0.33867365;
override c7: f32 = 0.4182131;
override k0: f32 = 0.3457383;

/// Energy compensation of Beckmann's glass, for a view from outside: N = 1/(R + T).
/// Fourteen operations: a nested sum with a reciprocal.
fn beckmann_glass_outside_14(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    return 1.0 + alpha_inverse * (c0 + alpha_inverse * (c1 + mu * (c2 + ior * (c3 + alpha_inverse
        * (c5 + ior * c6)) + alpha_inverse * (c4 + roughness * c7))));
}
