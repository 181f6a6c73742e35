override c0: f32 = 0.71387;
override c1: f32 = 1.12537;
override c2: f32 = -1.75396;
override c3: f32 = 2.84877;
override c4: f32 = -0.0506107;
override c5: f32 = -0.663263;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Six operations: a polynomial in roughness, alpha and mu, in Horner form.
/// Exactly 1 for a mirror.
fn ggx_norm_r6(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let grazing = c0 + roughness * (c1 * roughness + c2);
    let facing = c3 * alpha + c4 + c5 * mu;
    return 1.0 + roughness * (grazing + mu * facing);
}
