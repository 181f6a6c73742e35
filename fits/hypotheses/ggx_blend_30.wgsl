override c0: f32 = -0.0032785046;
override c1: f32 = -0.013422908;
override c2: f32 = -0.38020524;
override c3: f32 = 1.4318649;
override c4: f32 = -4.233991;
override d0: f32 = -0.00028287809;
override d1: f32 = 0.101648964;
override d2: f32 = -1.5486135;
override d3: f32 = 5.5233436;
override d4: f32 = 4.572225;
override d5: f32 = -7.278696;
override d6: f32 = 2.2034297;
override a0: f32 = 0.05112909;
override b0: f32 = 0.051324636;
override b1: f32 = 0.8533697;
override b2: f32 = 1.1610873;
override b3: f32 = -1.5599808;
override b4: f32 = 42.12245;
override b5: f32 = 8.941943;
override b6: f32 = 115.3802;
override b7: f32 = -142.23427;

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
