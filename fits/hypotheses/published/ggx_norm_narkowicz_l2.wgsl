/// Published: K. Narkowicz, "Analytical DFG Term for IBL", December 2014, the form after D. Lazarov: E, here as N = 1/E.
/// Takes gloss with alpha = (1 - gloss)^4, so gloss = 1 - sqrt(roughness) for alpha = roughness^2. Its E does not
/// depend on the view direction. Fitted to separable Smith.
fn ggx_norm_narkowicz_l2(roughness: f32) -> f32 {
    let gloss = 1.0 - sqrt(roughness);
    return 1.0 / saturate(1.301 * gloss + 0.4755);
}
