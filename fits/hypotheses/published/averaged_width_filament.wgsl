/// Published: Y. Tokuyoshi and A. Kaplanyan, Improved Geometric Specular Antialiasing, 2019, as in Filament: variances
/// add, at most 0.2 of it. The variance of normals is 1 - length along either axis.
fn averaged_width_filament(roughness: f32, mean_length: f32) -> f32 {
    let alpha = roughness * roughness;
    return sqrt(sqrt(min(alpha * alpha + min(2.0 * (1.0 - mean_length), 0.2), 1.0)));
}
