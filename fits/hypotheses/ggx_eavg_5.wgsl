override c0: f32 = -0.297094;
override c1: f32 = -3.08549;
override c2: f32 = 4.39858;
override c3: f32 = -1.60695;

/// Cosine-weighted mean over directions of the GGX reflection albedo, E_avg.
/// Five operations: odd powers of roughness are the basis that its loss calls for.
/// Exactly 1 for a mirror.
fn ggx_eavg_5(roughness: f32, alpha: f32) -> f32 {
    let loss = c0 + roughness * (c1 + roughness * (c2 + c3 * roughness));
    return 1.0 + roughness * alpha * loss;
}
