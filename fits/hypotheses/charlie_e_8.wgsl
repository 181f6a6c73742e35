override c0: f32 = -0.16075507;
override c1: f32 = 0.19879048;
override c2: f32 = 0.70542556;
override k: f32 = 1.1717598;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing.
/// Eight operations. mu and roughness times one reciprocal depend on mu/roughness alone, as the rim does.
fn charlie_e_8(roughness: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    return inverse * (c0 + roughness * (c1 + c2 * inverse));
}
