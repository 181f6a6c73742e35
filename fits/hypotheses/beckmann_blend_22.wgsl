override c0: f32 = -0.0012177059;
override c1: f32 = -0.17151195;
override c2: f32 = -0.31846565;
override c3: f32 = 0.17525597;
override d0: f32 = 0.0122522535;
override d1: f32 = 2.0552022;
override d2: f32 = -2.5017827;
override a0: f32 = 0.015352869;
override a1: f32 = -0.017114278;
override b0: f32 = 0.015329577;
override b1: f32 = 0.06011266;
override b2: f32 = 0.016199498;
override b3: f32 = 0.20896319;

/// Reflection of a Schlick Fresnel lobe of Beckmann's distribution, f0 A + B: f0 blends between B and E = A + B.
/// Twenty-two operations: quotients of sums of powers of mu and the widths.
fn beckmann_blend_22(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let alpha2 = alpha * alpha;
    let dividend = alpha * (c0 + mu * (c1 + c2 * alpha2 + c3 * mu));
    let divisor = alpha2 + mu * (d0 + mu * (d1 + d2 * roughness));
    let part = a0 + a1 * mu;
    let mu2 = mu * mu;
    let whole = b0 + mu * (b1 + mu2) + alpha * (b2 + b3 * roughness);
    return (dividend + divisor) * (part + f0 * (whole - part)) / (divisor * whole);
}
