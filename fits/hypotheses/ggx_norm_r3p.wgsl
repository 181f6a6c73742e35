override c0: f32 = 0.132818;
override c1: f32 = 2.2036;
override c2: f32 = -0.39617;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Three operations: a polynomial in roughness, alpha and mu, in Horner form.
/// Exactly 1 for a mirror.
fn ggx_norm_r3p(roughness: f32, alpha: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + mu * (c1 * alpha + c2));
}
