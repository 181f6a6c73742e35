override a0: f32 = 1.0;
override a1: f32 = 0.1;

/// Of roughness alone: every other input has one value.
/// One operation: a polynomial.
fn roughness_1(roughness: f32) -> f32 {
    return a0 + roughness * a1;
}
