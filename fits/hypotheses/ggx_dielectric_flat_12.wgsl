override c0: f32 = 1.1765732;
override c1: f32 = 71.67026;
override d0: f32 = 5.84633;
override d1: f32 = 85.05764;
override d2: f32 = -184.10918;
override d3: f32 = 1684.4766;
override d4: f32 = 306.4702;
override d5: f32 = 1809.8234;

/// Directional albedo R of a rough dielectric interface of one index of refraction, with its exact Fresnel term.
/// Twelve operations: a quotient.
fn ggx_dielectric_flat_12(roughness: f32, mu: f32) -> f32 {
    let dividend = c0 + c1 * mu;
    let divisor = 1.0 + d0 * roughness + mu * (d1 + roughness * (d2 + d3 * roughness) + mu * (d4 + d5 * mu));
    return dividend / divisor;
}
