override k: f32 = 1.0;
override c0: f32 = 0.0;
override c1: f32 = 0.4;
override c2: f32 = 0.4;
override c3: f32 = -0.3;
override c4: f32 = -0.4;

/// Roughness of the prefiltered lobe that is as wide as the lobe that glass refracts, seen from outside.
/// Eleven operations: the linear form, whose slope in the index rises where the view grazes facets,
/// r/(mu + k r).
fn refracted_width_11(roughness: f32, mu: f32, ior: f32) -> f32 {
    let layer = roughness / (mu + k * roughness);
    return roughness * (c0 + ior * (c1 + c2 * layer) + c3 * mu + c4 * roughness);
}
