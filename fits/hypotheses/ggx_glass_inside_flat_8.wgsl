override c0: f32 = 0.83438814;
override c1: f32 = -0.61249304;
override c2: f32 = -2.5171926;
override c3: f32 = 4.7088094;
override c4: f32 = 3.1079142;
override c5: f32 = -4.802742;
override c6: f32 = 2.9151802;
override c7: f32 = -2.3754435;

/// Energy compensation of glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Eight operations: a polynomial.
fn ggx_glass_inside_flat_8(roughness: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + c1 * mu + roughness * (c2 + roughness * (c3 + mu * (c4 + mu * (c5 + c6 * mu))
        + c7 * roughness)));
}
