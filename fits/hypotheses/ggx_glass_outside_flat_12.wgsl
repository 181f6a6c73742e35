override c0: f32 = 0.073186666;
override c1: f32 = -0.20176814;
override c2: f32 = -0.09160721;
override c3: f32 = 0.25691074;
override c4: f32 = -0.43807754;
override c5: f32 = 0.781696;
override c6: f32 = -0.07215345;
override k: f32 = 0.26944962;

/// Energy compensation of glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Twelve operations: a nested sum with a reciprocal.
fn ggx_glass_outside_flat_12(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    return 1.0 + alpha * (c0 + mu * (c1 + inverse * (c2 + inverse * (c3 + roughness * c4 + alpha * (c5 + inverse
        * c6)))));
}
