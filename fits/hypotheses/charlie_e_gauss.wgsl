override c0: f32 = 0.3521;
override c1: f32 = 0.1528;
override c2: f32 = 0.09467;
override d0: f32 = 2.193;
override d1: f32 = 0.2903;
override e0: f32 = -0.1351;
override e1: f32 = -0.2187;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing.
/// At grazing E is about 0.4/roughness, and the rim is as wide as the roughness: both are scales of this form.
fn charlie_e_gauss(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let x = mu / roughness;
    let level = (c0 + roughness * (c1 + c2 * roughness)) / roughness;
    return level * exp2(-x * (d0 + d1 * roughness + x * (e0 + e1 * alpha)));
}
