override c0: f32 = 2.3771477;
override d0: f32 = -0.00012599182;
override d1: f32 = 1.0376793;
override d2: f32 = 4.20866;
override d3: f32 = 29.691347;
override d4: f32 = -0.028952207;
override d5: f32 = 3.3831146;
override d6: f32 = -1.6548743;
override d7: f32 = 115.338295;
override d8: f32 = 29.63724;

/// Directional albedo R of a rough dielectric interface of one index of refraction, with its exact Fresnel term.
/// Fourteen operations: a quotient.
fn ggx_dielectric_flat_14(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let dividend = mu + c0 * alpha;
    let divisor = d0 + mu * (d1 + mu * (d2 + d3 * mu)) + roughness * (d4 + roughness * (d5 + roughness * (d6
        + d7 * mu + d8 * roughness)));
    return dividend / divisor;
}
