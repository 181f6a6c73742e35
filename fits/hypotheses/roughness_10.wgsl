override a0: f32 = 1.0;
override a1: f32 = 1.0;
override a2: f32 = 1.0;
override a3: f32 = 1.0;
override b0: f32 = 1.0;
override b1: f32 = 1.0;

/// Of roughness alone: every other input has one value.
/// Ten operations: a quotient, whose divisor has no term in roughness^2.
fn roughness_10(roughness: f32) -> f32 {
    let dividend = a0 + roughness * (a1 + roughness * (a2 + roughness * a3));
    let divisor = b0 + roughness * (b1 + roughness * roughness);
    return dividend / divisor;
}
