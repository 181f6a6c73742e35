override c0: f32 = 0.2705;
override c1: f32 = 0.4187;
override c2: f32 = -0.487;
override c3: f32 = -0.1395;

/// Roughness of the prefiltered lobe that is as wide as the lobe that glass refracts, seen from outside.
/// Four operations: linear in index, cosine and roughness.
fn refracted_width_4(roughness: f32, mu: f32, ior: f32) -> f32 {
    return roughness * (c0 + c1 * ior + c2 * mu + c3 * roughness);
}
