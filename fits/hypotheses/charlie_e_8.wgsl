override c0: f32 = 0.18118042;
override c1: f32 = 0.41454476;
override c2: f32 = -0.2148915;
override c3: f32 = -0.52241546;
override k: f32 = 1.1098683;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing. Where E is next to 0 the formula may be below it, by its error at most.
/// Eight operations. One reciprocal resolves the rim, mu ~ roughness.
fn charlie_e_8(roughness: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    return c0 + inverse * (c1 + mu * (c2 + inverse * c3));
}
