override c0: f32 = -0.36915556;
override c1: f32 = 0.3682932;
override c2: f32 = 1.5560654;
override c3: f32 = -0.6103684;
override c4: f32 = 0.3085367;
override d0: f32 = -0.36070368;
override d1: f32 = 0.3600447;
override d2: f32 = 0.28028864;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Twelve operations: a quotient.
fn cosine_ior_quotient_12(mu: f32, ior: f32) -> f32 {
    let dividend = c0 + ior * (c1 + mu * (c2 + mu * (c3 + c4 * mu)));
    let divisor = d0 + d1 * ior + mu * (ior + d2 * mu);
    return dividend / divisor;
}
