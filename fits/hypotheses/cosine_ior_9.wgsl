override c0: f32 = -0.36077866;
override c1: f32 = 0.73103195;
override c2: f32 = -0.19164078;
override c3: f32 = -0.17623527;
override c4: f32 = -0.7955462;
override c5: f32 = 0.26881236;
override c6: f32 = 0.8725212;
override c7: f32 = -0.052210335;
override c8: f32 = -0.35229343;
override c9: f32 = 0.056257024;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Nine operations: a sum.
fn cosine_ior_9(mu: f32, ior: f32) -> f32 {
    return c0 + ior * (c1 + c2 * ior) + mu * (c3 + ior * (c4 + c5 * ior) + mu * (c6 + c7 * ior + mu * (c8 + c9 * mu)));
}
