override c0: f32 = 0.15345724;
override c1: f32 = 0.2824259;
override c2: f32 = -0.4324568;
override c3: f32 = 1.5936807;
override c4: f32 = -4.897775;
override c5: f32 = 9.65363;
override c6: f32 = -15.047996;
override c7: f32 = -0.97664917;
override k0: f32 = 1.3083227;

/// Directional albedo E of the Charlie sheen lobe with the shadowing of Estevez and Kulla, which exceeds 1 at grazing where it is smooth. Where E is next to 0 the formula may be below it, by its error at most.
/// Thirteen operations, found by a search.
fn estevez_kulla_e_13(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * roughness);
    let mu_inverse = mu * inverse;
    return c0 + inverse * (c1 + mu_inverse * (c2 + alpha * (c4 + mu_inverse * (c5 + mu_inverse * c6))))
        + alpha * (c3 + roughness * c7);
}
