override a0: f32 = 1.0;
override a1: f32 = 0.1;
override a2: f32 = 0.1;

/// Of roughness alone: every other input has one value.
/// Two operations: a polynomial.
fn roughness_2(roughness: f32) -> f32 {
    return a0 + roughness * (a1 + roughness * a2);
}
