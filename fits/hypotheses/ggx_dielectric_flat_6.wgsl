override d0: f32 = 0.9691173;
override d1: f32 = 9.612022;
override d2: f32 = 12.250666;

/// Directional albedo R of a rough dielectric interface of one index of refraction, with its exact Fresnel term.
/// Six operations: a quotient.
fn ggx_dielectric_flat_6(alpha: f32, mu: f32) -> f32 {
    let divisor = d0 + d1 * mu + d2 * alpha;
    return 1.0 / divisor;
}
