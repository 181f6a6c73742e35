override a0: f32 = 1.0;
override a1: f32 = 0.1;
override a2: f32 = 0.1;
override a3: f32 = 0.1;
override a4: f32 = 0.1;
override a5: f32 = 0.1;

/// Of roughness alone: every other input has one value.
/// Five operations: a polynomial.
fn roughness_5(roughness: f32) -> f32 {
    return a0 + roughness * (a1 + roughness * (a2 + roughness * (a3 + roughness * (a4 + roughness * a5))));
}
