// The last function of the file is the formula; its arguments are any of roughness, alpha, mu.
// Overrides are free parameters. Lines with three slashes are its comment in the emitted code.
override c: f32 = 1.0;
override d: f32 = 0.1;

/// 1 + alpha (d + c alpha mu): affine in the cosine.
fn my_norm(alpha: f32, mu: f32) -> f32 {
    return 1.0 + alpha * (d + c * alpha * mu);
}
