override c0: f32 = 0.8959426;
override c1: f32 = -0.86410785;
override c2: f32 = -3.0472493;
override c3: f32 = 2.9043806;
override c4: f32 = -1.2206986;
override c5: f32 = 3.3251767;
override c6: f32 = -1.2144995;
override c7: f32 = 1.3009974;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Eight operations: a polynomial in roughness, alpha and mu, in Horner form.
/// Exactly 1 for a mirror.
fn ggx_norm_r8(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let rough = c2 + mu * (c3 + c4 * mu) + roughness * (c5 + alpha * (c6 + c7 * mu));
    return 1.0 + roughness * (c0 + c1 * mu + roughness * rough);
}
