/// Published: Y. Tokuyoshi and A. Kaplanyan, Improved Geometric Specular Antialiasing, 2019, as in Filament
/// (normalFiltering, shaders/src): alpha^2 + min(2 variance, 0.2). Its variance is that of screen-space
/// derivatives; that of these normals is 1 - length along either axis.
fn averaged_width_filament(roughness: f32, mean_length: f32) -> f32 {
    let alpha = roughness * roughness;
    return sqrt(sqrt(min(alpha * alpha + min(2.0 * (1.0 - mean_length), 0.2), 1.0)));
}
