override c0: f32 = 0.7086348;
override c1: f32 = -1.7383016;
override c2: f32 = 1.1145668;
override c3: f32 = 2.8420494;
override c4: f32 = -0.04560575;
override c5: f32 = -0.66543007;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Six operations: a polynomial in roughness and mu, in Horner form; the better of its cost by its largest error.
/// Exactly 1 for a mirror.
fn ggx_norm_r6p(roughness: f32, mu: f32) -> f32 {
    let rough = c0 + roughness * (c1 + roughness * (c2 + c3 * mu));
    return 1.0 + roughness * (rough + mu * (c4 + c5 * mu));
}
