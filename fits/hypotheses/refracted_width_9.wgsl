override c0: f32 = 0.28;
override c1: f32 = 0.55;
override c2: f32 = -0.3;
override c3: f32 = -0.2;
override c4: f32 = -0.14;

/// Roughness of the prefiltered lobe that is as wide as the lobe that glass refracts, seen from outside.
/// Nine operations: the linear form, whose slope in the index falls with the root of the cosine.
fn refracted_width_9(roughness: f32, mu: f32, ior: f32) -> f32 {
    return roughness * (c0 + ior * (c1 + c2 * sqrt(mu)) + c3 * mu + c4 * roughness);
}
