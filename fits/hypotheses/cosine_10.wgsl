override a0: f32 = 1.0;
override a1: f32 = 1.0;
override a2: f32 = 1.0;
override a3: f32 = 1.0;
override b0: f32 = 1.0;
override b1: f32 = 1.0;

/// Of the cosine of the view alone: every other input has one value.
/// Ten operations: a quotient, whose divisor has no term in mu^2.
fn cosine_10(mu: f32) -> f32 {
    let dividend = a0 + mu * (a1 + mu * (a2 + mu * a3));
    let divisor = b0 + mu * (b1 + mu * mu);
    return dividend / divisor;
}
