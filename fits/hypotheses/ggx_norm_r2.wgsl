override c0: f32 = -0.10002;
override c1: f32 = 1.53024;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Two operations; exactly 1 for a mirror.
fn ggx_norm_r2(alpha: f32, mu: f32) -> f32 {
    return 1.0 + alpha * (c0 + c1 * mu);
}
