override c0: f32 = -0.14801335;
override c1: f32 = -0.61832047;
override a0: f32 = 0.10103544;
override a1: f32 = -1.1226416;
override a2: f32 = 0.9440032;
override a3: f32 = 1.9480227;
override a4: f32 = -1.7248955;

/// Albedo f0 A + B of the GGX reflection lobe for a reflectance f0 at normal incidence (Schlick's Fresnel).
/// Nine operations: a polynomial each for E and B.
fn ggx_blend_9(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let bias = a0 + rest * (a1 + a2 * alpha + rest * (a3 + a4 * roughness));
    let albedo = 1.0 + alpha * (c0 + c1 * mu);
    return bias + f0 * (albedo - bias);
}
