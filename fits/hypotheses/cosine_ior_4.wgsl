override c0: f32 = 1.1016096;
override c1: f32 = 0.0018792391;
override c2: f32 = -0.77420557;
override c3: f32 = 1.495187;
override c4: f32 = -0.82535565;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Four operations: a sum.
fn cosine_ior_4(mu: f32, ior: f32) -> f32 {
    return c0 + c1 * ior + mu * (c2 + mu * (c3 + c4 * mu));
}
