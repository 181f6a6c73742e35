/// Published: Schlick's Fresnel with a roughness term, after S. Lagarde; Fdez-Aguera 2019 (k_S), LearnOpenGL.
/// Takes roughness. A Fresnel term without loss (E = 1).
fn ggx_blend_schlick_roughness(roughness: f32, mu: f32, f0: f32) -> f32 {
    let x = 1.0 - mu;
    let x2 = x * x;
    return f0 + (max(1.0 - roughness, f0) - f0) * (x2 * x2 * x);
}
