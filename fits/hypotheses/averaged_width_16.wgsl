override c0: f32 = 0.4556;
override c1: f32 = 4.0954;

/// Roughness of the lobe that is as wide as one averaged over normals whose mean has this length: alpha^2
/// grows by what the normals turn lights away, in the plane of incidence and with the cosine across it.
fn averaged_width_16(roughness: f32, mu: f32, mean_length: f32) -> f32 {
    let alpha = roughness * roughness;
    let spread = 1.0 - mean_length;
    return sqrt(sqrt(clamp(alpha * alpha + spread * (c0 + c1 * mu * mu), 1e-9, 1.0)));
}
