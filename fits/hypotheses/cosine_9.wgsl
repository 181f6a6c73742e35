override a0: f32 = 1.0;
override a1: f32 = 1.0;
override a2: f32 = 1.0;
override b1: f32 = 1.0;
override b2: f32 = 1.0;

/// Of the cosine of the view alone: every other input has one value.
/// Nine operations: a quotient.
fn cosine_9(mu: f32) -> f32 {
    let dividend = a0 + mu * (a1 + mu * a2);
    let divisor = 1.0 + mu * (b1 + mu * b2);
    return dividend / divisor;
}
