override c0: f32 = -0.04937789;
override c1: f32 = 0.24471283;
override c2: f32 = 0.56524044;
override c3: f32 = -2.1060617;
override c4: f32 = -0.31612933;
override b0: f32 = 1.0059704;
override b1: f32 = 2.6151187;
override b2: f32 = 26.324417;
override b3: f32 = 54.99639;
override b4: f32 = 1.8030521;
override b5: f32 = 34.19745;
override k: f32 = 0.8856106;

/// Albedo f0 A + B of the GGX reflection lobe for a reflectance f0 at normal incidence (Schlick's Fresnel).
/// Twenty-one operations: one reciprocal resolves the layer mu ~ alpha of E, another is B.
fn ggx_blend_21(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let whole = b0 + mu * (b1 + mu * (b2 + b3 * mu)) + roughness * (b4 + b5 * alpha);
    let albedo = 1.0 + alpha * (c0 + mu * (c1 + inverse * (c2 + c3 * roughness + c4 * inverse)));
    let bias = 1.0 / whole;
    return bias + f0 * (albedo - bias);
}
