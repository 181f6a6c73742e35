/// Published: M. Olano and D. Baker, LEAN Mapping, 2010: variances of slopes add. That of normals is 1 - length along
/// either axis, of facets alpha^2/2.
fn averaged_width_lean(roughness: f32, mean_length: f32) -> f32 {
    let alpha = roughness * roughness;
    return sqrt(sqrt(min(alpha * alpha + 2.0 * (1.0 - mean_length), 1.0)));
}
