override c0: f32 = 0.045935817;
override c1: f32 = 0.41450456;
override c2: f32 = -0.71920776;
override c3: f32 = 1.8167272;
override c4: f32 = -4.0395803;
override c5: f32 = 2.5687532;
override c6: f32 = 0.18968244;
override c7: f32 = -0.743641;
override c8: f32 = 2.656713;
override c9: f32 = -5.395127;
override c10: f32 = 3.1462946;
override k: f32 = 1.0625575;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing.
/// Sixteen operations. mu and roughness times one reciprocal depend on mu/roughness alone, as the rim does.
fn charlie_e_16(roughness: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    let ratio = mu * inverse;
    let rim = inverse * (c1 + ratio * (c2 + ratio * (c3 + ratio * (c4 + c5 * ratio))));
    return c0 + rim + roughness * (c6 + ratio * (c7 + ratio * (c8 + ratio * (c9 + c10 * ratio))));
}
