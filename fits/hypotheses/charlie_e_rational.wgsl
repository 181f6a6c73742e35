override c0: f32 = 0.3343;
override c1: f32 = 0.361;
override c2: f32 = -0.5762;
override d0: f32 = 1.938;
override d1: f32 = -1.348;
override e0: f32 = 7.493;
override e1: f32 = -8.619;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing.
/// A quotient of small polynomials; at grazing E is about 0.4/roughness.
fn charlie_e_rational(roughness: f32, mu: f32) -> f32 {
    let top = c0 + c1 * roughness + c2 * mu;
    return top / (roughness + mu * (d0 + d1 * roughness + mu * (e0 + e1 * roughness)));
}
