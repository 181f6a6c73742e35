override c: f32 = 0.3122;

/// Roughness of the lobe that is as wide as one lit by a disk of this angular radius: alpha grows with the
/// radius, as by Karis' rule.
fn lit_width_8(roughness: f32, light_radius: f32) -> f32 {
    return sqrt(clamp(roughness * roughness + c * light_radius, 1e-9, 1.0));
}
