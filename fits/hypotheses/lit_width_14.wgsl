override c: f32 = 0.1232;

/// Roughness of the lobe that is as wide as one lit by a disk of this angular radius: the squares of alpha
/// and radius add.
fn lit_width_14(roughness: f32, light_radius: f32) -> f32 {
    let alpha = roughness * roughness;
    return sqrt(sqrt(clamp(alpha * alpha + c * light_radius * light_radius, 1e-9, 1.0)));
}
