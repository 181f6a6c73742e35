override c0: f32 = 9.22388;
override c1: f32 = -9.171959;
override c2: f32 = 2.652461;
override c3: f32 = -15.752004;
override c4: f32 = 22.612762;
override c5: f32 = -7.036282;
override c6: f32 = -9.654101;
override c7: f32 = -2.273642;
override c8: f32 = 1.9736098;
override c9: f32 = 14.961841;
override c10: f32 = -8.350801;
override c11: f32 = 1.7574593;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Twelve operations: a sum.
fn cosine_ior_12(mu: f32, ior: f32) -> f32 {
    let t0 = ior * mu;
    return c0 + ior * (c1 + c2 * ior) + mu * (c3 + ior * (c4 + c5 * ior) + mu * (c6 + ior * (c7 + c8 * ior) + mu * (c9 + t0 * (c10 + c11 * t0))));
}
