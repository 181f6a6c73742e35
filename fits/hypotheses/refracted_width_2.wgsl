override c0: f32 = 0.0033;
override c1: f32 = 0.4147;

/// Roughness of the prefiltered lobe that is as wide as the lobe that glass refracts, seen from outside.
/// Two operations: linear in the index of refraction, and the same for every view.
fn refracted_width_2(roughness: f32, ior: f32) -> f32 {
    return roughness * (c0 + c1 * ior);
}
