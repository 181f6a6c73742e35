override c0: f32 = 0.00067998405;
override c1: f32 = -0.31965405;
override c2: f32 = 1.0003893;
override c3: f32 = -1.2168428;
override d0: f32 = 0.00075132534;
override d1: f32 = 2.934977;
override d2: f32 = -2.9121542;
override a0: f32 = 0.062672235;
override a1: f32 = -0.07499087;
override b0: f32 = 0.064033106;
override b1: f32 = 0.1407451;
override b2: f32 = 1.3042696;

/// Reflection of a Schlick Fresnel lobe of Beckmann's distribution, f0 A + B: f0 blends between B and E = A + B.
/// Twenty-one operations: quotients of sums of powers of mu and the widths.
fn beckmann_blend_21(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let dividend = alpha * (c0 + mu * (c1 + mu * (c2 + c3 * roughness)));
    let alpha2 = alpha * alpha;
    let divisor = alpha2 + mu * (d0 + mu * (d1 + d2 * roughness));
    let part = a0 + a1 * mu;
    let whole = b0 + mu * (b1 + b2 * mu) + alpha * roughness;
    return (dividend + divisor) * (part + f0 * (whole - part)) / (divisor * whole);
}
