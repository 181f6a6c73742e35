/// Published: M. Toksvig, Mipmapping Normal Maps, 2005. The exponent s of the lobe falls to f s, f = length/(length +
/// s (1 - length)); of GGX by alpha^2 = 2/(s + 2).
fn averaged_width_toksvig(roughness: f32, mean_length: f32) -> f32 {
    let alpha = roughness * roughness;
    let exponent = 2.0 / (alpha * alpha) - 2.0;
    let factor = mean_length / (mean_length + exponent * (1.0 - mean_length));
    return sqrt(sqrt(2.0 / (factor * exponent + 2.0)));
}
