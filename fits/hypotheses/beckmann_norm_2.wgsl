override c0: f32 = -0.2527322;
override c1: f32 = 0.88281566;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Two operations. A polynomial in mu and the widths.
/// Exactly 1 for a mirror.
fn beckmann_norm_2(alpha: f32, mu: f32) -> f32 {
    return 1.0 + alpha * (c0 + c1 * mu);
}
