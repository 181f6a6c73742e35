override c0: f32 = 0.3277921;
override c1: f32 = -0.38659713;
override c2: f32 = 0.42535716;
override c3: f32 = -3.0288007;
override c4: f32 = 3.7999115;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Six operations. A polynomial in mu and the widths.
/// Exactly 1 for a mirror.
fn beckmann_norm_6(roughness: f32, mu: f32) -> f32 {
    let t0 = mu * roughness;
    return 1.0 + roughness * (c0 + roughness * (c1 + t0 * (c2 + c3 * mu + c4 * t0)));
}
