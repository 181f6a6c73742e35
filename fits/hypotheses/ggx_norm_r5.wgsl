override c0: f32 = 0.422242;
override c1: f32 = -0.486504;
override c2: f32 = 0.459718;
override c3: f32 = 2.88536;
override c4: f32 = -1.22214;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Five operations: a polynomial in roughness, alpha and mu, in Horner form.
/// Exactly 1 for a mirror.
fn ggx_norm_r5(roughness: f32, alpha: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + c1 * roughness + mu * (c2 + c3 * alpha + c4 * mu));
}
