override c0: f32 = 0.77506304;
override c1: f32 = 3.7994137;
override c2: f32 = -2.0713298;
override c3: f32 = 0.4349585;
override c4: f32 = -3.1332104;
override c5: f32 = -3.0680227;
override c6: f32 = 4.02626;
override k: f32 = 0.95202017;

/// Energy compensation of glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Twelve operations: a nested sum with a reciprocal.
fn ggx_glass_inside_flat_12(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    return 1.0 + alpha * (c0 + mu * (c1 + inverse * (c2 + inverse * c3) + mu * (c4 + alpha * (c5 + mu * c6))));
}
