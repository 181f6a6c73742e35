override c0: f32 = 0.13705789;
override c1: f32 = 0.7849577;
override c2: f32 = 0.21567701;
override c3: f32 = -1.9776143;
override c4: f32 = -1.4030068;
override c5: f32 = 1.1779172;
override k: f32 = 2.2023745;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing.
/// Eleven operations. mu and roughness times one reciprocal depend on mu/roughness alone, as the rim does.
fn charlie_e_11(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    let ratio = mu * inverse;
    let rim = c1 + c2 * alpha + ratio * (c3 + c4 * roughness + c5 * ratio);
    return c0 + inverse * rim;
}
