override c0: f32 = -0.102131136;
override c1: f32 = 1.2914135;
override c2: f32 = 6.670683;
override c3: f32 = -2.6290388;
override c4: f32 = 2.8770568;
override c5: f32 = -6.9678216;
override c6: f32 = 6.8916907;
override c7: f32 = -22.671118;
override c8: f32 = 25.047388;
override k: f32 = 1.6686482;

/// Energy compensation of glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Fifteen operations: a nested sum with a reciprocal.
fn ggx_glass_inside_flat_15(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    return 1.0 + ratio * (c0 + alpha * (c1 + mu * (c2 + inverse * (c3 + inverse * c4) + mu * (c5 + ratio * (c6
        + alpha * (c7 + mu * c8))))));
}
