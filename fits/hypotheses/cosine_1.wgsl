override a0: f32 = 1.0;
override a1: f32 = 0.1;

/// Of the cosine of the view alone: every other input has one value.
/// One operation: a polynomial.
fn cosine_1(mu: f32) -> f32 {
    return a0 + mu * a1;
}
