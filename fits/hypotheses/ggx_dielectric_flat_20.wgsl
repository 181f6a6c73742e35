override c0: f32 = 0.09288455;
override c1: f32 = 3.5592346;
override c2: f32 = 2.6300495;
override c3: f32 = 0.5384488;
override c4: f32 = -1.7622504;
override c5: f32 = -2.877108;
override d0: f32 = -0.00012019256;
override d1: f32 = 0.65843344;
override d2: f32 = 6.837544;
override d3: f32 = 0.11440254;
override d4: f32 = -0.75138;
override d5: f32 = 8.972268;
override d6: f32 = 3.793588;
override d7: f32 = 30.572622;

/// Directional albedo R of a rough dielectric interface of one index of refraction, with its exact Fresnel term.
/// Twenty operations: a quotient; the better of its cost from an index of 2 on.
fn ggx_dielectric_flat_20(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let mu2 = mu * mu;
    let dividend = mu * (c0 + mu * (c1 + c2 * mu2)) + alpha * (c3 + roughness * (mu * (c4 + c5 * mu2) + roughness));
    let divisor = d0 + alpha * (d1 + d2 * alpha) + mu * (d3 + roughness * (d4 + d5 * roughness) + mu * (d6 + d7
        * mu));
    return dividend / divisor;
}
