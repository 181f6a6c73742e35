override c: f32 = 1.4646;

/// Roughness of the lobe that is as wide as one averaged over normals whose mean has this length: alpha^2
/// grows by c (1 - length), the same for every view.
fn averaged_width_14(roughness: f32, mean_length: f32) -> f32 {
    let alpha = roughness * roughness;
    return sqrt(sqrt(clamp(alpha * alpha + c * (1.0 - mean_length), 1e-9, 1.0)));
}
