override d0: f32 = 0.9626873;
override d1: f32 = 5.0432835;
override d2: f32 = 33.160416;
override d3: f32 = 2.1585913;
override d4: f32 = -52.66358;
override d5: f32 = 9.457831;
override d6: f32 = 144.69255;

/// Directional albedo R of a rough dielectric interface of one index of refraction, with its exact Fresnel term.
/// Ten operations: a quotient.
fn ggx_dielectric_flat_10(roughness: f32, mu: f32) -> f32 {
    let divisor = d0 + mu * (d1 + d2 * mu) + roughness * (d3 + d4 * mu + roughness * (d5 + d6 * mu));
    return 1.0 / divisor;
}
