override c0: f32 = 0.0982;
override c1: f32 = 0.1359;

/// Roughness of the lobe that is as wide as one lit by a disk of this angular radius: the squares of alpha
/// and radius add, the more the more the view is face on.
fn lit_width_15(roughness: f32, mu: f32, light_radius: f32) -> f32 {
    let alpha = roughness * roughness;
    return sqrt(sqrt(clamp(alpha * alpha + light_radius * light_radius * (c0 + c1 * mu), 1e-9, 1.0)));
}
