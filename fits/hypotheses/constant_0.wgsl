override c0: f32 = 0.5;

/// A number: every input has one value.
/// No operations.
fn constant_0(roughness: f32) -> f32 {
    return c0;
}
