override c0: f32 = 0.69901353;
override c1: f32 = -0.93088716;
override c2: f32 = 5.666095;
override c3: f32 = -1.0386822;
override c4: f32 = -4.4843755;
override c5: f32 = 0.508623;
override c6: f32 = 1.6921688;
override c7: f32 = -11.786769;
override c8: f32 = 12.472098;
override c9: f32 = 12.693239;
override k: f32 = 0.92294353;

/// Energy compensation of glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Sixteen operations: a nested sum with a reciprocal.
fn ggx_glass_inside_flat_16(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = mu * inverse;
    return 1.0 + alpha * (c0 + ratio * (c1 + alpha * (c2 + inverse * (c3 + ratio * (c5 + inverse * c6)) + mu
        * (c4 + alpha * (c7 + ratio * (c8 + alpha * c9))))));
}
