override c0: f32 = -0.20280164;
override c1: f32 = 0.14889206;
override c2: f32 = 6.4048104;
override c3: f32 = -1.1243179;
override c4: f32 = -0.42254072;
override c5: f32 = -53.15691;
override c6: f32 = 7.4824176;
override c7: f32 = 69.96566;
override c8: f32 = -6.649875;
override c9: f32 = 118.9428;
override c10: f32 = -3.696173;
override c11: f32 = -107.849815;
override k: f32 = 1.6021181;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing. Where E is next to 0 the formula may be below it, by its error at most.
/// Sixteen operations. One reciprocal resolves the rim, mu ~ roughness. In half precision charlie_e_15 errs less.
fn charlie_e_16(roughness: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    return c0 + roughness * (c1 + inverse * (c2 + inverse * (c3 + roughness * (c5 + inverse * (c6 + roughness
        * (c7 + inverse * (c8 + mu * (c9 + inverse * (c10 + roughness * c11))))))) + mu * c4));
}
