override c0: f32 = -0.8239649;
override c1: f32 = 0.60045356;
override c2: f32 = 2.9143317;
override c3: f32 = -2.0762987;
override c4: f32 = 0.8335754;
override c5: f32 = -3.9608686;
override c6: f32 = 1.8205703;
override b0: f32 = 1.0868793;
override b1: f32 = 0.2810697;
override b2: f32 = 48.863445;
override b3: f32 = 17.558043;

/// Reflection of a Schlick Fresnel lobe, f0 A + B: E = A + B and B are two forms, and f0 blends between them.
/// Sixteen operations: a polynomial for E, one reciprocal for B.
fn beckmann_blend_16(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rough = c2 + mu * (c3 + c4 * mu) + roughness * (c5 + c6 * roughness);
    let albedo = 1.0 + roughness * (c0 + c1 * mu + roughness * rough);
    let bias = 1.0 / (b0 + mu * (b1 + b2 * mu) + b3 * alpha);
    return bias + f0 * (albedo - bias);
}
