/// Published: A. Pesce and M. Iwanicki, "Approximate Models for Physically Based Rendering", 2015; NVIDIA MathLib,
/// EnvironmentTerm_Pesce: A and B. Takes rough with alpha = rough^4, inferred from the data; here rough =
/// sqrt(roughness), alpha = roughness^2. Not fitted to height-correlated Smith.
fn ggx_blend_pesce_iwanicki(roughness: f32, mu: f32, f0: f32) -> f32 {
    let rough = sqrt(roughness);
    let m = rough * rough;
    let bias = exp2(-(7.0 * mu + 4.0 * m));
    let scale = 1.0 - bias - m * max(bias, min(rough, 0.739 + 0.323 * mu) - 0.434);
    return f0 * scale + bias;
}
