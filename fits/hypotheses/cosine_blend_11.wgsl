override a0: f32 = 1.0;
override a1: f32 = 1.0;
override a2: f32 = 1.0;
override b0: f32 = 0.1;
override b1: f32 = 0.1;
override d1: f32 = 1.0;
override d2: f32 = 1.0;

/// f0 A + B of f0 and the cosine of the view alone: roughness has one value.
/// Eleven operations: two quotients with one divisor.
fn cosine_blend_11(mu: f32, f0: f32) -> f32 {
    let dividend = f0 * (a0 + mu * (a1 + mu * a2)) + (b0 + mu * b1);
    let divisor = 1.0 + mu * (d1 + mu * d2);
    return dividend / divisor;
}
