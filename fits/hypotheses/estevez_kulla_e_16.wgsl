override c0: f32 = 0.034188796;
override c1: f32 = -0.061374404;
override c2: f32 = -0.5480937;
override c3: f32 = 3.059608;
override c4: f32 = -131.66287;
override c5: f32 = -2.7377896;
override c6: f32 = 1062.6859;
override c7: f32 = -2723.8667;
override c8: f32 = 9.431599;
override c9: f32 = 2305.732;
override c10: f32 = -8.709742;
override k0: f32 = 2.0580087;

/// Directional albedo E of the Charlie sheen lobe with the shadowing of Estevez and Kulla, which exceeds 1 at grazing where it is smooth. Where E is next to 0 the formula may be below it, by its error at most.
/// Sixteen operations, found by a search.
fn estevez_kulla_e_16(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * roughness);
    let roughness_inverse = roughness * inverse;
    return c0 + roughness_inverse * (c1 + inverse * (c2 + roughness_inverse * (c3 + alpha * (c4 + mu * c5
        + roughness_inverse * (c6 + roughness_inverse * (c7 + roughness_inverse * c9) + alpha * (c8 + alpha * c10))))));
}
