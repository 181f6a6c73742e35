override d0: f32 = 1.0325948;
override d1: f32 = 3.226274;
override d2: f32 = 28.569143;
override d3: f32 = 0.8213471;
override d4: f32 = 11.682048;

/// Directional albedo R of a rough dielectric interface of one index of refraction, with its exact Fresnel term.
/// Eight operations: a quotient.
fn ggx_dielectric_flat_8(roughness: f32, mu: f32) -> f32 {
    let divisor = d0 + mu * (d1 + d2 * mu) + roughness * (d3 + d4 * roughness);
    return 1.0 / divisor;
}
