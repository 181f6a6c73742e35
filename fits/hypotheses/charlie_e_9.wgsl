override c0: f32 = 0.23822255;
override c1: f32 = 0.5550799;
override c2: f32 = -0.8318336;
override c3: f32 = -1.4433854;
override k: f32 = 1.6119812;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing.
/// Nine operations. mu and roughness times one reciprocal depend on mu/roughness alone, as the rim does.
fn charlie_e_9(roughness: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    return c0 + inverse * (c1 + mu * inverse * (c2 + c3 * roughness));
}
