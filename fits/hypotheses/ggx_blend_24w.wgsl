override c0: f32 = -0.0055086575;
override c1: f32 = -0.41884467;
override c2: f32 = 0.25932804;
override c3: f32 = -3.5402308;
override d0: f32 = 0.051572606;
override d1: f32 = -0.9575073;
override d2: f32 = 6.2771997;
override d3: f32 = 4.578263;
override d4: f32 = -5.673917;
override a0: f32 = 0.0068778866;
override b0: f32 = 0.006727377;
override b1: f32 = 0.09944078;
override b2: f32 = 0.036428;
override b3: f32 = -1.1829718;
override b4: f32 = 3.3531933;

/// Reflection of a Schlick Fresnel lobe, f0 A + B: E = A + B and the share B/E are two forms, and f0 blends between E and B.
/// Twenty-four operations, of less error than ggx_blend_24, for the range of f32: one division for both forms, of a divisor that
/// is near the least of a half where mu and alpha are small.
fn ggx_blend_24w(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let dividend = alpha * (c0 + mu * (c1 + alpha * (c2 + c3 * alpha)));
    let bend = alpha * roughness;
    let divisor = bend + mu * (d0 + roughness * (d1 + d2 * bend) + mu * (d3 + d4 * roughness));
    let mu2 = mu * mu;
    let whole = b0 + b1 * alpha + mu * (b2 + alpha * (b3 + b4 * roughness) + mu2);
    return (dividend + divisor) * (a0 + f0 * (whole - a0)) / (divisor * whole);
}
