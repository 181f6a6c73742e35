override c0: f32 = 0.15138495;
override c1: f32 = 2.0424232;
override c2: f32 = -5.747512;
override c3: f32 = -4.689137;
override c4: f32 = 8.971503;
override c5: f32 = -44.227295;
override c6: f32 = 74.40526;
override c7: f32 = 35.332817;
override c8: f32 = -57.00168;
override c9: f32 = 1.698544;
override k0: f32 = 1.5754322;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Sixteen operations: a nested sum with a reciprocal.
fn beckmann_glass_inside_flat_16(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    return 1.0 + alpha_inverse * (c0 + alpha * (c1 + mu * (c2 + alpha * (c4 + mu * (c5 + inverse
        * c6 + mu * (c7 + inverse * c8)))) + alpha_inverse * (c3 + alpha * c9)));
}
