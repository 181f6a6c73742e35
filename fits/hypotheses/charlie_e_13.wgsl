override c0: f32 = 0.121185265;
override c1: f32 = -0.13992396;
override c2: f32 = 0.72381866;
override c3: f32 = -0.13772686;
override c4: f32 = -7.2923183;
override c5: f32 = 22.072115;
override c6: f32 = 0.17670275;
override c7: f32 = -17.254286;
override k: f32 = 1.0891752;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing. Where E is next to 0 the formula may be below it, by its error at most.
/// Thirteen operations. One reciprocal resolves the rim, mu ~ roughness.
fn charlie_e_13(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    let ratio = roughness * inverse;
    return c0 + inverse * (c1 + ratio * (c2 + ratio * (c3 + mu * (c4 + ratio * (c5 + ratio * c7)) + alpha * c6)));
}
