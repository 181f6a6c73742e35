/// Published: 1 - F with Schlick's Fresnel and a roughness term, after S. Lagarde; Fdez-Aguera 2019 (k_D), LearnOpenGL.
/// Takes roughness.
fn coupling_schlick_roughness(roughness: f32, mu: f32, f0: f32) -> f32 {
    let x = 1.0 - mu;
    let x2 = x * x;
    return 1.0 - (f0 + (max(1.0 - roughness, f0) - f0) * (x2 * x2 * x));
}
