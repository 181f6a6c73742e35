/// Published: K. Narkowicz, "Analytical DFG Term for IBL", December 2014: B and E.
/// Takes gloss with alpha = (1 - gloss)^4, so gloss = 1 - sqrt(roughness) for alpha = roughness^2; ports that pass
/// 1 - roughness are wrong. Callers also multiply B by saturate(50 f0), which is left out here. Fitted to separable Smith.
fn ggx_blend_narkowicz_p1(roughness: f32, mu: f32, f0: f32) -> f32 {
    let gloss = 1.0 - sqrt(roughness);
    let g2 = gloss * gloss;
    let m2 = mu * mu;
    let bias = saturate(min(-0.1688 * gloss + 1.895 * g2, 0.9903 - 4.853 * mu + 8.404 * m2 - 5.069 * (m2 * mu)));
    let plain = 0.6045 + 1.699 * gloss - 0.5228 * mu - 3.603 * g2;
    let mixed = 1.404 * gloss * mu + 0.1939 * m2 + 2.661 * (g2 * gloss);
    return mix(bias, saturate(plain + mixed), f0);
}
