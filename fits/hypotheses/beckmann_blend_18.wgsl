override c0: f32 = -0.6662482;
override c1: f32 = 3.281001;
override c2: f32 = -2.8608966;
override c3: f32 = 1.9177382;
override c4: f32 = -12.196065;
override c5: f32 = 11.897382;
override c6: f32 = -1.2950332;
override c7: f32 = 8.845181;
override c8: f32 = -9.500907;
override a0: f32 = 0.017069194;
override a1: f32 = -0.17501356;
override a2: f32 = 1.1210256;
override a3: f32 = -4.735167;
override a4: f32 = 6.096727;
override a5: f32 = -2.2713406;

/// Reflection of a Schlick Fresnel lobe of Beckmann's distribution, f0 A + B: f0 blends between B and E = A + B.
/// Eighteen operations: a polynomial.
fn beckmann_blend_18(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let rest2 = rest * rest;
    let bias = a0 + rest2 * (a1 + rest2 * (a2 + alpha * (a3 + roughness * (a4 + a5 * roughness))));
    let albedo = 1.0 + roughness * (c0 + mu * (c1 + c2 * mu) + roughness * (c3 + mu * (c4 + c5 * mu)
        + roughness * (c6 + mu * (c7 + c8 * mu))));
    return bias + f0 * (albedo - bias);
}
