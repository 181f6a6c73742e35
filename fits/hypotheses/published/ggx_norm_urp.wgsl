/// Published: Unity URP, BRDF.hlsl, EnvironmentBRDFSpecular: E = 1/(alpha^2 + 1), here as N = 1/E. Takes alpha.
/// It does not depend on the view direction.
fn ggx_norm_urp(alpha: f32) -> f32 {
    return alpha * alpha + 1.0;
}
