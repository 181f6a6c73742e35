override c0: f32 = -0.46041283;
override c1: f32 = 0.5578617;
override c2: f32 = 0.232552;
override c3: f32 = 0.8158184;
override c4: f32 = -1.34077;
override c5: f32 = -0.30398166;
override a0: f32 = 0.049411107;
override a1: f32 = -0.21202122;
override a2: f32 = 1.1089298;
override a3: f32 = -3.516067;
override a4: f32 = 2.6948006;

/// Reflection of a Schlick Fresnel lobe of Beckmann's distribution, f0 A + B: f0 blends between B and E = A + B.
/// Fourteen operations: a polynomial.
fn beckmann_blend_14(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let rest2 = rest * rest;
    let bias = a0 + rest2 * (a1 + rest2 * (a2 + alpha * (a3 + a4 * roughness)));
    let albedo = 1.0 + roughness * (c0 + mu * (c1 + c2 * mu) + roughness * (c3 + c4 * mu + c5 * alpha));
    return bias + f0 * (albedo - bias);
}
