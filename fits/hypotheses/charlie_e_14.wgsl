override c0: f32 = 0.07031021;
override c1: f32 = -0.15519837;
override c2: f32 = 0.39851394;
override c3: f32 = 0.31744853;
override c4: f32 = -0.66149163;
override c5: f32 = 1.6728051;
override c6: f32 = -3.74174;
override c7: f32 = 2.3907883;
override c8: f32 = -0.7587741;
override k: f32 = 1.0320626;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing. Where E is next to 0 the formula may be below it, by its error at most.
/// Fourteen operations. mu and roughness times one reciprocal depend on mu/roughness alone, as the rim does.
fn charlie_e_14(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * roughness);
    let ratio = mu * inverse;
    let tail = c5 + ratio * (c6 + ratio * (c7 + c8 * roughness));
    let rim = inverse * (c2 + c3 * alpha + ratio * (c4 + ratio * tail));
    return c0 + c1 * roughness + rim;
}
