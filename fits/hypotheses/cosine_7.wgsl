override a0: f32 = 1.0;
override a1: f32 = 1.0;
override b1: f32 = 1.0;

/// Of the cosine of the view alone: every other input has one value.
/// Seven operations: a quotient.
fn cosine_7(mu: f32) -> f32 {
    let dividend = a0 + mu * a1;
    let divisor = 1.0 + mu * b1;
    return dividend / divisor;
}
