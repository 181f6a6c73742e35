override c0: f32 = 1.2736384;
override c1: f32 = -0.15094472;
override c2: f32 = 2.1652603;
override c3: f32 = 0.27343696;
override c4: f32 = -9.16461;
override c5: f32 = 11.401883;
override c6: f32 = -4.8233104;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Six operations: a sum.
fn cosine_ior_6(mu: f32, ior: f32) -> f32 {
    return c0 + c1 * ior + mu * (c2 + c3 * ior + mu * (c4 + mu * (c5 + c6 * mu)));
}
