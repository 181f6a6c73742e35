override c0: f32 = 0.9659496;
override c1: f32 = -2.540963;
override c2: f32 = 2.3942149;
override c3: f32 = -4.4225893;
override c4: f32 = 15.632149;
override c5: f32 = -10.308343;
override c6: f32 = 1.8018411;
override c7: f32 = -15.789776;
override c8: f32 = 11.4439335;
override c9: f32 = 2.342903;

/// Energy compensation of glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Ten operations: a polynomial.
fn ggx_glass_inside_flat_10(roughness: f32, alpha: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + roughness * (c1 + c2 * roughness) + mu * (c3 + roughness * (c4 + c5 * alpha)
        + mu * (c6 + roughness * (c7 + c8 * alpha) + c9 * mu)));
}
