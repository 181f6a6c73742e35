override c0: f32 = -0.44442046;
override c1: f32 = 0.93404305;
override c2: f32 = -0.5964923;
override c3: f32 = -1.3917291;
override c4: f32 = 0.7865609;
override a0: f32 = -0.058655187;
override a1: f32 = 0.061429746;
override a2: f32 = 1.0259186;
override a3: f32 = -1.8835602;
override a4: f32 = 0.96168613;

/// Albedo f0 A + B of the GGX reflection lobe for a reflectance f0 at normal incidence (Schlick's Fresnel).
/// Thirteen operations: a polynomial each for E and B.
fn ggx_blend_13(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let rest2 = rest * rest;
    let bias = a0 + rest2 * (a1 + rest2 * (a2 + roughness * (a3 + a4 * alpha)));
    let albedo = 1.0 + roughness * (c0 + roughness * (c1 + roughness * (c2 + mu * (c3 + c4 * mu))));
    return bias + f0 * (albedo - bias);
}
