override c: f32 = 0.731;

/// Furnace normalisation of the GGX reflection lobe (height-correlated Smith), N with E N = 1.
/// One operation, blind to the view direction; holds for alpha in [0, 1].
fn ggx_norm_r1(alpha: f32) -> f32 {
    return 1.0 + c * alpha;
}
