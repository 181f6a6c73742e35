override c0: f32 = -0.20367624;
override c1: f32 = 4.15874;
override c2: f32 = 0.22720069;
override c3: f32 = -7.532284;
override c4: f32 = -0.31248245;
override c5: f32 = 4.978499;
override c6: f32 = 0.23529856;
override c7: f32 = -5.5328684;
override c8: f32 = 6.7695827;
override k: f32 = 1.9437046;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Fifteen operations. One reciprocal: mu and alpha times it depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness.
/// Exactly 1 for a mirror.
fn ggx_norm_i15(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    let layer = ratio * (c1 + alpha * (c2 + c3 * inverse));
    let facing = mu * (c4 + c5 * alpha + mu * (c6 + alpha * (c7 + c8 * alpha)));
    return 1.0 + ratio * (c0 + layer + facing);
}
