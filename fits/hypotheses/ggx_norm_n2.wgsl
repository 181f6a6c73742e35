override c: f32 = 1.0;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// The cheaper form of Pesce, "Misunderstanding Multiscattering" (2019), 1 + alpha^2, with its constant free.
/// Blind to the view direction.
fn ggx_norm_n2(alpha: f32) -> f32 {
    return 1.0 + c * alpha * alpha;
}
