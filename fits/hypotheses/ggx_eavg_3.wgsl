override c0: f32 = 0.24608545;
override c1: f32 = -2.0506356;
override c2: f32 = 1.2143805;

/// Cosine-weighted mean over directions of the GGX reflection albedo, E_avg.
/// Three operations: a polynomial in roughness and alpha, in Horner form.
/// Exactly 1 for a mirror.
fn ggx_eavg_3(roughness: f32, alpha: f32) -> f32 {
    return 1.0 + alpha * (c0 + roughness * (c1 + c2 * roughness));
}
