override c0: f32 = 0.002600524;
override c1: f32 = 1.9620345;
override c2: f32 = -2.4283643;
override c3: f32 = -0.25760555;
override c4: f32 = 0.57200867;
override k: f32 = 0.28334284;

/// Energy compensation of glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Eleven operations: a nested sum with a reciprocal.
fn ggx_glass_outside_flat_11(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = mu * inverse;
    return 1.0 + alpha * (c0 + ratio * (c1 + ratio * (c2 + inverse * (c3 + ratio * c4))));
}
