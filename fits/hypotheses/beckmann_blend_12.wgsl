override c0: f32 = -0.32401547;
override c1: f32 = 0.3825387;
override c2: f32 = 0.37347046;
override c3: f32 = -0.9603587;
override a0: f32 = 0.049411107;
override a1: f32 = -0.21202122;
override a2: f32 = 1.1089298;
override a3: f32 = -3.516067;
override a4: f32 = 2.6948006;

/// Reflection of a Schlick Fresnel lobe of Beckmann's distribution, f0 A + B: f0 blends between B and E = A + B.
/// Twelve operations: a polynomial.
fn beckmann_blend_12(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let rest2 = rest * rest;
    let bias = a0 + rest2 * (a1 + rest2 * (a2 + alpha * (a3 + a4 * roughness)));
    let albedo = 1.0 + roughness * (c0 + c1 * roughness + mu * (c2 + c3 * alpha));
    return bias + f0 * (albedo - bias);
}
