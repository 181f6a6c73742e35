override c0: f32 = 0.6532083;
override c1: f32 = -0.47954366;
override c2: f32 = -1.591244;
override c3: f32 = 3.2003138;
override c4: f32 = 0.8937609;
override c5: f32 = -1.4386505;

/// Energy compensation of glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Six operations: a polynomial.
fn ggx_glass_inside_flat_6(roughness: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + c1 * mu + roughness * (c2 + roughness * (c3 + c4 * mu + c5 * roughness)));
}
