override c0: f32 = 0.38909;
override c1: f32 = 2.92899;
override d0: f32 = 1.18097;
override d1: f32 = 1.61408;
override d2: f32 = -2.35779;
override k0: f32 = 12.4517;
override k1: f32 = 24.6397;
override k2: f32 = 1.51197;
override k3: f32 = -16.0845;
override k4: f32 = 10.1303;

/// Albedo f0 A + B of the GGX reflection lobe for a reflectance f0 at normal incidence (Schlick's Fresnel).
/// Thirty operations: E rational in alpha and mu as 1/N of ggx_norm_q13, which resolves the layer mu ~ alpha, and B as a part of E,
/// which is smoother than B. Exactly 1 for f0 = 1 at alpha = 0 and at mu = 0.
fn ggx_blend_30(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let a2 = alpha * alpha;
    let loss = alpha * mu * (c0 + c1 * a2);
    let divisor = a2 + mu * (d0 * alpha + mu * (d1 + d2 * alpha));
    let x = 1.0 - mu;
    let part = x * x * x / (1.0 + alpha * (k0 + k1 * alpha) + mu * (k2 + k3 * roughness + k4 * mu));
    return divisor / (divisor + loss) * mix(part, 1.0, f0);
}
