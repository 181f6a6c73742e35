override c0: f32 = 3.753159e-5;
override c1: f32 = 0.009376321;
override c2: f32 = 0.01988081;
override d0: f32 = 3.4032128e-5;
override d1: f32 = 0.009606427;
override d2: f32 = 0.047189787;
override d3: f32 = 0.25461093;
override d4: f32 = 0.026237786;
override d5: f32 = 0.2257081;

/// Directional albedo R of a rough dielectric interface of one index of refraction, with its exact Fresnel term.
/// Thirteen operations: a quotient.
fn ggx_dielectric_flat_13(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let dividend = c0 + c1 * mu + c2 * alpha;
    let divisor = d0 + mu * (d1 + mu * (d2 + d3 * mu)) + alpha * (d4 + roughness * (mu + d5 * roughness));
    return dividend / divisor;
}
