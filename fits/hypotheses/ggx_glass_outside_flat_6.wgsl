override c0: f32 = 0.5992801;
override c1: f32 = -1.6531365;
override c2: f32 = 1.1878384;
override c3: f32 = 3.0054214;
override c4: f32 = -7.028665;
override c5: f32 = 4.082443;

/// Energy compensation of glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Six operations: a polynomial.
fn ggx_glass_outside_flat_6(roughness: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + roughness * (c1 + roughness * (c2 + mu * (c3 + mu * (c4 + c5 * mu)))));
}
