override c0: f32 = 0.00093787943;
override c1: f32 = 0.012099664;
override c2: f32 = 0.019166319;
override c3: f32 = 0.046483666;
override d0: f32 = 0.0009809257;
override d1: f32 = 0.079874896;
override d2: f32 = 0.43375966;
override d3: f32 = -0.3163287;
override d4: f32 = 0.013073211;
override d5: f32 = 0.18089187;
override d6: f32 = -0.29215583;

/// Directional albedo R of a rough dielectric interface of one index of refraction, with its exact Fresnel term.
/// Fifteen operations: a quotient; the better of its cost from an index of 2 on.
fn ggx_dielectric_flat_15(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let dividend = c0 + mu * (c1 + c2 * mu) + c3 * alpha;
    let divisor = d0 + alpha * (d1 + alpha * (d2 + d3 * roughness)) + mu * (d4 + alpha * roughness + mu * (d5
        + d6 * alpha));
    return dividend / divisor;
}
