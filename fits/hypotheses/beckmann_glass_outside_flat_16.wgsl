override c0: f32 = 0.067935;
override c1: f32 = 0.22442685;
override c2: f32 = -1.1583669;
override c3: f32 = -1.8194952;
override c4: f32 = 14.850678;
override c5: f32 = -24.695038;
override c6: f32 = 11.8593855;
override c7: f32 = 0.0436081;
override c8: f32 = 6.0127487;
override k0: f32 = 1.1783413;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Sixteen operations: a nested sum with a reciprocal.
fn beckmann_glass_outside_flat_16(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    let mu_alpha_inverse = mu * alpha_inverse;
    return 1.0 + mu_alpha_inverse * (c0 + roughness * c1 + alpha_inverse * (c2 + inverse * (c3
        + alpha_inverse * (c4 + alpha_inverse * (c5 + alpha_inverse * (c6 + alpha * (c7 + alpha
        * c8)))))));
}
