override c0: f32 = -0.14197;
override c1: f32 = 0.19775;
override c2: f32 = -0.85128;

/// Albedo f0 A + B of the GGX reflection lobe for a reflectance f0 at normal incidence (Schlick's Fresnel).
/// Eleven operations: a polynomial for E, and B without a coefficient.
/// Exactly Schlick's albedo with power 4 for a mirror.
fn ggx_blend_11(roughness: f32, mu: f32, f0: f32) -> f32 {
    let albedo = 1.0 + roughness * (c0 + mu * (c1 + c2 * roughness));
    let x = 1.0 - mu;
    let root = (1.0 - roughness) * (x * x);
    return mix(root * root, albedo, f0);
}
