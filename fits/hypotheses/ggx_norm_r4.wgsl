override c0: f32 = 0.359812;
override c1: f32 = -0.31817;
override c2: f32 = 2.64896;
override c3: f32 = -0.649997;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Four operations: a polynomial in roughness, alpha and mu, in Horner form.
/// Exactly 1 for a mirror.
fn ggx_norm_r4(roughness: f32, alpha: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + c1 * roughness + mu * (c2 * alpha + c3));
}
