override d0: f32 = 1.0526665;
override d1: f32 = 3.8870113;
override d2: f32 = 20.944519;
override d3: f32 = 16.867102;

/// Directional albedo R of a rough dielectric interface of one index of refraction, with its exact Fresnel term.
/// Seven operations: a quotient.
fn ggx_dielectric_flat_7(alpha: f32, mu: f32) -> f32 {
    let divisor = d0 + mu * (d1 + d2 * mu) + d3 * alpha;
    return 1.0 / divisor;
}
