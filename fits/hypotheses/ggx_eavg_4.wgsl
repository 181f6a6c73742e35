override c0: f32 = -0.040052753;
override c1: f32 = -3.8344703;
override c2: f32 = 5.180025;
override c3: f32 = -1.8966689;

/// Cosine-weighted mean over directions of the GGX reflection albedo, E_avg.
/// Four operations: a polynomial in roughness and alpha, in Horner form.
/// Exactly 1 for a mirror.
fn ggx_eavg_4(roughness: f32, alpha: f32) -> f32 {
    return 1.0 + alpha * (c0 + alpha * (c1 + roughness * (c2 + c3 * roughness)));
}
