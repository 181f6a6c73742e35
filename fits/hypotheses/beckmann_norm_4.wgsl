override c0: f32 = 0.09318012;
override c1: f32 = -0.31036025;
override c2: f32 = 1.4521846;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Four operations. A polynomial in mu and the widths.
/// Exactly 1 for a mirror.
fn beckmann_norm_4(alpha: f32, mu: f32) -> f32 {
    let t0 = alpha * mu;
    return 1.0 + alpha * (c0 + t0 * (c1 + c2 * t0));
}
