override c0: f32 = -0.507581;
override c1: f32 = 0.19675946;
override c2: f32 = 0.3645662;
override c3: f32 = -0.1281938;
override c4: f32 = 0.7751328;
override k: f32 = 0.4874738;

/// Energy compensation of glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Ten operations: a nested sum with a reciprocal.
fn ggx_glass_outside_flat_10(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    return 1.0 + alpha * (c0 + inverse * (c1 + alpha * (c2 + inverse * (c3 + mu * c4))));
}
