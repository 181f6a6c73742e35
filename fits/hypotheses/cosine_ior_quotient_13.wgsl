override c0: f32 = 1.0;
override c1: f32 = 1.0;
override c2: f32 = 1.0;
override c3: f32 = 1.0;
override c4: f32 = 1.0;
override c5: f32 = 1.0;
override d1: f32 = 1.0;
override d2: f32 = 1.0;
override d3: f32 = 1.0;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Thirteen operations: a quotient.
fn cosine_ior_quotient_13(mu: f32, ior: f32) -> f32 {
    let dividend = c0 + c1 * ior + mu * (c2 + c3 * ior + mu * (c4 + ior * c5));
    let divisor = 1.0 + d3 * ior + mu * (d1 + mu * d2);
    return dividend / divisor;
}
