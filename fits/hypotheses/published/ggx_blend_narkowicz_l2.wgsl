/// Published: K. Narkowicz, "Analytical DFG Term for IBL", December 2014, the form after D. Lazarov: B and E.
/// Takes gloss with alpha = (1 - gloss)^4, so gloss = 1 - sqrt(roughness) for alpha = roughness^2. Fitted to separable Smith.
fn ggx_blend_narkowicz_l2(roughness: f32, mu: f32, f0: f32) -> f32 {
    let gloss = 1.0 - sqrt(roughness);
    let t1 = 0.5745 * gloss + 0.5753;
    let t2 = 1.548 * gloss - 0.2511;
    let t3 = -0.02397 * gloss - 0.02066;
    let t4 = 1.301 * gloss + 0.4755;
    let bias = saturate(t1 * min(t2, exp2(-7.672 * mu)) + t3);
    return mix(bias, saturate(t4), f0);
}
