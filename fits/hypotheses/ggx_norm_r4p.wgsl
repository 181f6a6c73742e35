override c0: f32 = 0.110614;
override c1: f32 = 2.27559;
override c2: f32 = 2.7189;
override c3: f32 = -2.88596;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Four operations: a polynomial in alpha and mu, in Horner form; the better of its cost by RMS.
/// Exactly 1 for a mirror.
fn ggx_norm_r4p(alpha: f32, mu: f32) -> f32 {
    return 1.0 + alpha * (c0 + mu * (c1 + mu * (c2 * alpha + c3)));
}
