override c: f32 = 0.731;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// One operation, blind to the view direction.
fn ggx_norm_r1(alpha: f32) -> f32 {
    return 1.0 + c * alpha;
}
