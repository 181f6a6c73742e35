override a0: f32 = 1.0;
override a1: f32 = 1.0;
override a2: f32 = 1.0;
override b1: f32 = 1.0;
override b2: f32 = 1.0;

/// Of roughness alone: every other input has one value.
/// Nine operations: a quotient.
fn roughness_9(roughness: f32) -> f32 {
    let dividend = a0 + roughness * (a1 + roughness * a2);
    let divisor = 1.0 + roughness * (b1 + roughness * b2);
    return dividend / divisor;
}
