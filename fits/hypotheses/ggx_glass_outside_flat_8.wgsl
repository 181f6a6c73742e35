override c0: f32 = 0.98795444;
override c1: f32 = -0.18669191;
override c2: f32 = -4.986937;
override c3: f32 = 8.19507;
override c4: f32 = 3.0083535;
override c5: f32 = -6.101863;
override c6: f32 = 3.3651507;
override c7: f32 = -4.135739;

/// Energy compensation of glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Eight operations: a polynomial.
fn ggx_glass_outside_flat_8(roughness: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + c1 * mu + roughness * (c2 + roughness * (c3 + mu * (c4 + mu * (c5 + c6 * mu))
        + c7 * roughness)));
}
