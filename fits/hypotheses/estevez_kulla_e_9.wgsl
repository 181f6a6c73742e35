override c0: f32 = 0.7569266;
override c1: f32 = -1.1153153;
override c2: f32 = 0.36804244;
override c3: f32 = 0.77841973;
override c4: f32 = -0.8062259;
override k0: f32 = 0.8048832;

/// Directional albedo E of the Charlie sheen lobe with the shadowing of Estevez and Kulla, which exceeds 1 at grazing where it is smooth. Where E is next to 0 the formula may be below it, by its error at most.
/// Nine operations, found by a search.
fn estevez_kulla_e_9(roughness: f32, mu: f32) -> f32 {
    let inverse_root = inverseSqrt(mu + k0 * roughness);
    return c0 + inverse_root * (c1 + inverse_root * (c2 + roughness * (c3 + mu * c4)));
}
