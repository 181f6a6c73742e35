override c0: f32 = 1.2372997;
override c1: f32 = -0.13374464;
override c2: f32 = 2.9081018;
override c3: f32 = 0.25152013;
override c4: f32 = -15.894644;
override c5: f32 = 32.190575;
override c6: f32 = -30.22712;
override c7: f32 = 10.671211;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Seven operations: a sum.
fn cosine_ior_7(mu: f32, ior: f32) -> f32 {
    return c0 + c1 * ior + mu * (c2 + c3 * ior + mu * (c4 + mu * (c5 + mu * (c6 + c7 * mu))));
}
