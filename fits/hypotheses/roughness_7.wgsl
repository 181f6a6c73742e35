override a0: f32 = 1.0;
override a1: f32 = 1.0;
override b1: f32 = 1.0;

/// Of roughness alone: every other input has one value.
/// Seven operations: a quotient.
fn roughness_7(roughness: f32) -> f32 {
    let dividend = a0 + roughness * a1;
    let divisor = 1.0 + roughness * b1;
    return dividend / divisor;
}
