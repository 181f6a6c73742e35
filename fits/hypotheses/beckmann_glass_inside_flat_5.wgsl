override c0: f32 = 0.13873649;
override c1: f32 = 2.6143095;
override c2: f32 = -4.4697127;
override c3: f32 = 2.3984678;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Five operations: a polynomial.
fn beckmann_glass_inside_flat_5(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let t0 = roughness * mu;
    return 1.0 + alpha * (c0 + t0 * (c1 + mu * (c2 + c3 * t0)));
}
