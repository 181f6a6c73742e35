override c0: f32 = 0.03930352;
override c1: f32 = 0.49614203;
override c2: f32 = -0.97496825;
override c3: f32 = 2.113826;
override c4: f32 = -4.683843;
override c5: f32 = 3.1828518;
override c6: f32 = 0.18928142;
override c7: f32 = -0.42047483;
override k: f32 = 1.2962034;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing.
/// Thirteen operations. mu and roughness times one reciprocal depend on mu/roughness alone, as the rim does.
fn charlie_e_13(roughness: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    let ratio = mu * inverse;
    let rim = inverse * (c1 + ratio * (c2 + ratio * (c3 + ratio * (c4 + c5 * ratio))));
    return c0 + rim + roughness * (c6 + c7 * ratio);
}
