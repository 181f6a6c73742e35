override c0: f32 = -0.1548683;
override c1: f32 = 0.4974143;
override c2: f32 = 0.83876824;
override c3: f32 = -0.56401783;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Four operations: a polynomial.
fn beckmann_glass_inside_flat_4(roughness: f32, alpha: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + alpha * (c1 + mu * (c2 + c3 * mu)));
}
