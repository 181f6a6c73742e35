override a0: f32 = 1.0;
override a1: f32 = 1.0;
override a2: f32 = 1.0;
override a3: f32 = 1.0;
override b1: f32 = 1.0;
override b2: f32 = 1.0;
override b3: f32 = 1.0;

/// Of the cosine of the view alone: every other input has one value.
/// Eleven operations: a quotient.
fn cosine_11(mu: f32) -> f32 {
    let dividend = a0 + mu * (a1 + mu * (a2 + mu * a3));
    let divisor = 1.0 + mu * (b1 + mu * (b2 + mu * b3));
    return dividend / divisor;
}
