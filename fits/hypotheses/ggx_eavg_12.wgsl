override c0: f32 = -4.993269e-5;
override c1: f32 = -0.7275827;
override c2: f32 = -0.64602;
override c3: f32 = -0.3304613;
override d0: f32 = 0.08904586;
override d1: f32 = 0.6692591;
override d2: f32 = 1.1257966;

/// Cosine-weighted mean over directions of the GGX reflection albedo, E_avg.
/// Twelve operations: a quotient in roughness and alpha, good to some units of f32.
/// Exactly 1 for a mirror.
fn ggx_eavg_12(roughness: f32, alpha: f32) -> f32 {
    let loss = alpha * (c0 + alpha * (c1 + roughness * (c2 + c3 * alpha)));
    let divisor = d0 + roughness * (d1 + alpha * (d2 + alpha * roughness));
    return 1.0 + loss / divisor;
}
