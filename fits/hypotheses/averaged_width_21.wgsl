override c0: f32 = 0.5019;
override c1: f32 = 1.527;
override c2: f32 = -1.3423;
override c3: f32 = 2.2105;
override c4: f32 = 1.4096;
override c5: f32 = 20.0146;

/// Roughness of the lobe that is as wide as one averaged over normals whose mean has this length: alpha^2
/// grows by a form linear in alpha and in what the length lacks of 1, with another slope face on.
fn averaged_width_21(roughness: f32, mu: f32, mean_length: f32) -> f32 {
    let alpha = roughness * roughness;
    let spread = 1.0 - mean_length;
    let face_on = mu * mu * mu * (c3 + c4 * alpha + c5 * spread);
    return sqrt(sqrt(clamp(alpha * alpha + spread * (c0 + c1 * alpha + c2 * spread + face_on), 1e-9, 1.0)));
}
