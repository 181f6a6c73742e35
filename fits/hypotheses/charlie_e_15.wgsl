override c0: f32 = -0.29387176;
override c1: f32 = 0.13364924;
override c2: f32 = 0.700141;
override c3: f32 = 1.0735958;
override c4: f32 = 7.075392;
override c5: f32 = -1.6489925;
override c6: f32 = -58.668713;
override c7: f32 = 1.0170221;
override c8: f32 = 73.53176;
override c9: f32 = -7.8904614;
override c10: f32 = 105.72418;
override k: f32 = 1.704764;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing. Where E is next to 0 the formula may be below it, by its error at most.
/// Fifteen operations. One reciprocal resolves the rim, mu ~ roughness.
fn charlie_e_15(roughness: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    return c0 + roughness * (c1 + inverse * (c2 + inverse * (c3 + mu * (c4 + inverse * (c5 + roughness * (c6
        + inverse * (c7 + roughness * (c8 + mu * (c9 + inverse * c10)))))))));
}
