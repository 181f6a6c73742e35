override c0: f32 = 0.30344838;
override c1: f32 = -0.29889357;
override c2: f32 = 0.008059041;
override c3: f32 = 1.3113897;
override c4: f32 = -1.8206201;
override k: f32 = 1.6280998;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing. Where E is next to 0 the formula may be below it, by its error at most.
/// Nine operations. One reciprocal resolves the rim, mu ~ roughness.
fn charlie_e_9(roughness: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    return c0 + inverse * (c1 + inverse * (c2 + roughness * (c3 + mu * c4)));
}
