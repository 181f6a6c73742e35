override c0: f32 = -0.06300446;
override c1: f32 = -0.19979101;
override c2: f32 = 1.2044226;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Three operations. A polynomial in mu and the widths.
/// Exactly 1 for a mirror.
fn beckmann_norm_3(alpha: f32, mu: f32) -> f32 {
    return 1.0 + alpha * (c0 + mu * (c1 + c2 * alpha));
}
