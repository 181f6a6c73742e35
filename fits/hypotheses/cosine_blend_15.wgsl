override a0: f32 = 1.0;
override a1: f32 = 1.0;
override a2: f32 = 1.0;
override a3: f32 = 1.0;
override b0: f32 = 0.1;
override b1: f32 = 0.1;
override b2: f32 = 0.1;
override b3: f32 = 0.1;
override d1: f32 = 1.0;
override d2: f32 = 1.0;
override d3: f32 = 1.0;

/// f0 A + B of f0 and the cosine of the view alone: roughness has one value.
/// Fifteen operations: two quotients with one divisor.
fn cosine_blend_15(mu: f32, f0: f32) -> f32 {
    let dividend = f0 * (a0 + mu * (a1 + mu * (a2 + mu * a3))) + (b0 + mu * (b1 + mu * (b2 + mu * b3)));
    let divisor = 1.0 + mu * (d1 + mu * (d2 + mu * d3));
    return dividend / divisor;
}
