override k: f32 = 1.0;
override c0: f32 = 0.0;
override c1: f32 = 0.4;
override c2: f32 = 0.4;
override c3: f32 = -0.3;
override c4: f32 = -0.4;
override c5: f32 = 0.01;
override c6: f32 = 0.01;
override c7: f32 = 0.01;

/// Roughness of the prefiltered lobe that is as wide as the lobe that glass refracts, seen from outside.
/// Fourteen operations: refracted_width_11 with a square of the index, and slopes in cosine and index that
/// roughness turns.
fn refracted_width_14(roughness: f32, mu: f32, ior: f32) -> f32 {
    let layer = roughness / (mu + k * roughness);
    let along = c1 + c2 * layer + c5 * ior + c7 * roughness;
    return roughness * (c0 + mu * (c3 + c6 * roughness) + ior * along + c4 * roughness);
}
