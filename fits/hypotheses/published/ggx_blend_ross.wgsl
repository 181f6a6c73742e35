/// Published: NVIDIA MathLib and NRD, EnvironmentTerm_Ross: B, with A = 1 - B: a Fresnel term without loss (E = 1).
/// Takes alpha.
fn ggx_blend_ross(alpha: f32, mu: f32, f0: f32) -> f32 {
    let bias = pow(1.0 - mu, 5.0 * exp(-2.69 * alpha)) / (1.0 + 22.7 * pow(alpha, 1.5));
    return f0 * (1.0 - bias) + bias;
}
