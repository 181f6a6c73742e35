override c0: f32 = -0.35793;
override c1: f32 = 0.35592;
override c2: f32 = -0.22244;
override c3: f32 = -1.4906;
override c4: f32 = 1.0274;
override k0: f32 = 1.00689;
override k1: f32 = -2.01015;
override k2: f32 = 0.97588;

/// Albedo f0 A + B of the GGX reflection lobe for a reflectance f0 at normal incidence (Schlick's Fresnel).
/// Fourteen operations: a polynomial each for E and B.
fn ggx_blend_14(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let albedo = 1.0 + roughness * (c0 + c1 * roughness + mu * (c2 + c3 * roughness + c4 * mu));
    let x = 1.0 - mu;
    let x2 = x * x;
    let bias = x2 * x2 * (k0 + k1 * roughness + k2 * alpha);
    return mix(bias, albedo, f0);
}
