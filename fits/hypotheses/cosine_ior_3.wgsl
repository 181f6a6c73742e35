override c0: f32 = 0.08895249;
override c1: f32 = 0.1359209;
override c2: f32 = -0.6327157;
override c3: f32 = 0.38960904;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Three operations: a sum.
fn cosine_ior_3(mu: f32, ior: f32) -> f32 {
    return c0 + c1 * ior + mu * (c2 + c3 * mu);
}
