override a0: f32 = 1.0;
override a1: f32 = 1.0;
override a2: f32 = 1.0;
override a3: f32 = 1.0;
override a4: f32 = 1.0;
override b1: f32 = 1.0;
override b2: f32 = 1.0;
override b3: f32 = 1.0;
override b4: f32 = 1.0;

/// Of roughness alone: every other input has one value.
/// Thirteen operations: a quotient.
fn roughness_13(roughness: f32) -> f32 {
    let dividend = a0 + roughness * (a1 + roughness * (a2 + roughness * (a3 + roughness * a4)));
    let divisor = 1.0 + roughness * (b1 + roughness * (b2 + roughness * (b3 + roughness * b4)));
    return dividend / divisor;
}
