override c0: f32 = -0.0030793778;
override c1: f32 = -0.013519525;
override c2: f32 = -0.47156242;
override c3: f32 = 1.7584518;
override c4: f32 = -4.5066395;
override d0: f32 = -0.00018640509;
override d1: f32 = 0.08365281;
override d2: f32 = -1.4428854;
override d3: f32 = 5.512177;
override d4: f32 = 5.465808;
override d5: f32 = -9.529442;
override d6: f32 = 3.5588741;
override a0: f32 = 0.060325786;
override b0: f32 = 0.061114483;
override b1: f32 = 0.9832056;
override b2: f32 = 1.1469873;
override b3: f32 = -1.7290066;
override b4: f32 = 43.13868;
override b5: f32 = 10.312003;
override b6: f32 = 122.780945;
override b7: f32 = -157.2353;

/// Reflection of a Schlick Fresnel lobe, f0 A + B: E = A + B and the share B/E are two forms, and f0 blends between E and B.
/// Thirty operations: two quotients with one division.
fn ggx_blend_30(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let loss = alpha * (c0 + c1 * alpha + mu * (c2 + alpha * (c3 + c4 * roughness)));
    let slope = d1 + roughness * (d2 + d3 * alpha) + mu * (d4 + roughness * (d5 + d6 * roughness));
    let divisor = d0 + alpha * roughness + mu * slope;
    let rest = 1.0 - mu;
    let falloff = b2 + roughness * (b3 + b4 * alpha) + mu * (b5 + mu * (b6 + b7 * rest));
    let part = a0 + mu * rest;
    let whole = b0 + b1 * alpha + mu * falloff;
    return (divisor + loss) * (part + f0 * (whole - part)) / (divisor * whole);
}
