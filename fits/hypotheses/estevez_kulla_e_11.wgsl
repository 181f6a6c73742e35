override c0: f32 = 0.024713317;
override c1: f32 = -0.077099815;
override c2: f32 = -0.22288427;
override c3: f32 = 0.45022348;
override c4: f32 = 1.339891;
override c5: f32 = -1.0971351;
override c6: f32 = 1.2613842;
override k0: f32 = 1.2170013;

/// Directional albedo E of the Charlie sheen lobe with the shadowing of Estevez and Kulla, which exceeds 1 at grazing where it is smooth. Where E is next to 0 the formula may be below it, by its error at most.
/// Eleven operations, found by a search.
fn estevez_kulla_e_11(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * roughness);
    return c0 + inverse * (c1 + roughness * (c2 + inverse * (c3 + alpha * (c4 + alpha * (c5
        + inverse * c6)))));
}
