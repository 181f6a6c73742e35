override c: f32 = 1.0;
override d: f32 = 0.1;

/// The last function of the file is the formula; its arguments are any of roughness, alpha, mu; overrides are free parameters.
fn my_norm(alpha: f32, mu: f32) -> f32 {
    return 1.0 + alpha * (d + c * alpha * mu);
}
