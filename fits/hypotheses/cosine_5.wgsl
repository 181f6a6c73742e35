override a0: f32 = 1.0;
override a1: f32 = 0.1;
override a2: f32 = 0.1;
override a3: f32 = 0.1;
override a4: f32 = 0.1;
override a5: f32 = 0.1;

/// Of the cosine of the view alone: every other input has one value.
/// Five operations: a polynomial.
fn cosine_5(mu: f32) -> f32 {
    return a0 + mu * (a1 + mu * (a2 + mu * (a3 + mu * (a4 + mu * a5))));
}
