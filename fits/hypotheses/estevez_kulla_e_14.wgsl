override c0: f32 = 0.039488833;
override c1: f32 = -0.054742713;
override c2: f32 = 0.32217568;
override c3: f32 = -4.020106;
override c4: f32 = 17.832623;
override c5: f32 = -25.272669;
override c6: f32 = 1.5917939;
override c7: f32 = 11.733218;
override c8: f32 = -0.83360827;
override k0: f32 = 1.0874262;

/// Directional albedo E of the Charlie sheen lobe with the shadowing of Estevez and Kulla, which exceeds 1 at grazing where it is smooth. Where E is next to 0 the formula may be below it, by its error at most.
/// Fourteen operations, found by a search.
fn estevez_kulla_e_14(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * roughness);
    let roughness_inverse = roughness * inverse;
    return c0 + inverse * (c1 + roughness_inverse * (c2 + roughness * (c3 + roughness_inverse * (c4
        + roughness_inverse * (c5 + roughness_inverse * c7) + alpha * (c6 + alpha * c8)))));
}
