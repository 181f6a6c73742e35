override c0: f32 = -0.61498445;
override c1: f32 = 0.40278083;
override c2: f32 = 1.383243;
override c3: f32 = -1.7481916;
override c4: f32 = 0.72257775;
override c5: f32 = -0.864197;
override a0: f32 = -0.058655187;
override a1: f32 = 0.061429746;
override a2: f32 = 1.0259186;
override a3: f32 = -1.8835602;
override a4: f32 = 0.96168613;

/// Albedo f0 A + B of the GGX reflection lobe for a reflectance f0 at normal incidence (Schlick's Fresnel).
/// Fourteen operations: a polynomial each for E and B.
fn ggx_blend_14(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let rest2 = rest * rest;
    let bias = a0 + rest2 * (a1 + rest2 * (a2 + roughness * (a3 + a4 * alpha)));
    let albedo = 1.0 + roughness * (c0 + c1 * mu + roughness * (c2 + mu * (c3 + c4 * mu) + c5 * roughness));
    return bias + f0 * (albedo - bias);
}
