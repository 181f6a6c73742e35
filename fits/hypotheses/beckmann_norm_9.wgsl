override c0: f32 = 0.7010944;
override c1: f32 = -2.0210192;
override c2: f32 = 1.3679112;
override c3: f32 = -3.5196934;
override c4: f32 = 13.280916;
override c5: f32 = -9.951214;
override c6: f32 = 2.21021;
override c7: f32 = -7.600814;
override c8: f32 = 6.7396975;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Nine operations. A polynomial in mu and the widths.
/// Exactly 1 for a mirror.
fn beckmann_norm_9(roughness: f32, alpha: f32, mu: f32) -> f32 {
    return 1.0 + roughness * (c0 + roughness * (c1 + c2 * roughness) + mu * (c3 + roughness * (c4 + c5 * roughness)
        + mu * (c6 + roughness * (c7 + c8 * alpha))));
}
