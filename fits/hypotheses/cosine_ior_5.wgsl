override c0: f32 = 1.1446674;
override c1: f32 = -0.014321915;
override c2: f32 = -0.9489547;
override c3: f32 = 0.085880145;
override c4: f32 = 1.5052508;
override c5: f32 = -0.81648874;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Five operations: a sum.
fn cosine_ior_5(mu: f32, ior: f32) -> f32 {
    return c0 + c1 * ior + mu * (c2 + c3 * ior + mu * (c4 + c5 * mu));
}
