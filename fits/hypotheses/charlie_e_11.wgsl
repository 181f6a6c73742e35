override c0: f32 = 0.26234746;
override c1: f32 = -0.13397618;
override c2: f32 = -0.07633592;
override c3: f32 = -1.4151714;
override c4: f32 = 0.25629833;
override c5: f32 = 2.2413113;
override c6: f32 = 3.5639892;
override k: f32 = 2.028106;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing. Where E is next to 0 the formula may be below it, by its error at most.
/// Eleven operations. One reciprocal resolves the rim, mu ~ roughness.
fn charlie_e_11(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    return c0 + inverse * (c1 + roughness * c3 + alpha * (c4 + inverse * (c5 + inverse * c6))) + mu * c2;
}
