override c0: f32 = 0.674124;
override c1: f32 = -3.1538901;
override c2: f32 = 4.8284917;
override c3: f32 = -2.3118684;
override c4: f32 = 0.35365155;
override c5: f32 = -0.4029603;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Six operations: a polynomial.
fn beckmann_glass_outside_flat_6(roughness: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + roughness * (c1 + roughness * (c2 + roughness * (c3 + mu * (c4
        + c5 * mu)))));
}
