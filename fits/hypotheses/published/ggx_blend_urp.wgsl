/// Published: Unity URP, BRDF.hlsl, EnvironmentBRDFSpecular, with a reflectivity of f0.
/// Takes roughness and alpha = roughness^2. Its albedo E = 1/(alpha^2 + 1) does not depend on the view direction.
fn ggx_blend_urp(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let fresnel = (1.0 - mu) * (1.0 - mu);
    let grazing = saturate(1.0 - roughness + f0);
    return 1.0 / (alpha * alpha + 1.0) * (f0 + (grazing - f0) * (fresnel * fresnel));
}
