override c0: f32 = 0.16709648;
override c1: f32 = -0.096712925;
override c2: f32 = -1.509766;
override c3: f32 = 0.18540177;
override c4: f32 = 3.010243;
override c5: f32 = 3.4458816;
override k: f32 = 2.0453992;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing. Where E is next to 0 the formula may be below it, by its error at most.
/// Ten operations. One reciprocal resolves the rim, mu ~ roughness.
fn charlie_e_10(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    return c0 + inverse * (c1 + roughness * c2 + alpha * (c3 + inverse * (c4 + inverse * c5)));
}
