/// Published: K. Narkowicz, "Analytical DFG Term for IBL", December 2014: E, here as N = 1/E.
/// Takes gloss with alpha = (1 - gloss)^4, so gloss = 1 - sqrt(roughness) for alpha = roughness^2; ports that pass
/// 1 - roughness are wrong. Fitted to separable Smith.
fn ggx_norm_narkowicz_p1(roughness: f32, mu: f32) -> f32 {
    let gloss = 1.0 - sqrt(roughness);
    let g2 = gloss * gloss;
    let plain = 0.6045 + 1.699 * gloss - 0.5228 * mu - 3.603 * g2;
    let mixed = 1.404 * gloss * mu + 0.1939 * (mu * mu) + 2.661 * (g2 * gloss);
    return 1.0 / saturate(plain + mixed);
}
