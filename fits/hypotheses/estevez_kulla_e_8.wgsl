override c0: f32 = -0.026703332;
override c1: f32 = -0.027247706;
override c2: f32 = 0.020931745;
override c3: f32 = 1.0859435;
override k0: f32 = 1.0864683;

/// Directional albedo E of the Charlie sheen lobe with the shadowing of Estevez and Kulla, which exceeds 1 at grazing where it is smooth. Where E is next to 0 the formula may be below it, by its error at most.
/// Eight operations, found by a search.
fn estevez_kulla_e_8(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * roughness);
    return c0 + inverse * (c1 + inverse * (c2 + alpha * c3));
}
