override a0: f32 = 1.0;
override a1: f32 = 1.0;
override a2: f32 = 1.0;
override a3: f32 = 1.0;
override b0: f32 = 0.1;
override b1: f32 = 0.1;
override b2: f32 = 0.1;
override b3: f32 = 0.1;
override b4: f32 = 0.1;

/// f0 A + B of f0 and the cosine of the view alone: roughness has one value.
/// Eight operations: two polynomials.
fn cosine_blend_8(mu: f32, f0: f32) -> f32 {
    return f0 * (a0 + mu * (a1 + mu * (a2 + mu * a3))) + (b0 + mu * (b1 + mu * (b2 + mu * (b3 + mu * b4))));
}
