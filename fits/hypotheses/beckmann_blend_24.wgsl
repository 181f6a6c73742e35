override c0: f32 = -0.008575707;
override c1: f32 = -0.047458984;
override c2: f32 = -0.03311255;
override c3: f32 = -0.17377591;
override c4: f32 = 0.079375885;
override d0: f32 = -0.0008473975;
override d1: f32 = 0.26669672;
override d2: f32 = 1.8347073;
override d3: f32 = -0.83732885;
override d4: f32 = -1.9327667;
override a0: f32 = 0.020842824;
override a1: f32 = -0.028630985;
override b0: f32 = 0.02084241;
override b1: f32 = 0.07777029;
override b2: f32 = 0.012784552;
override b3: f32 = 0.29418963;

/// Reflection of a Schlick Fresnel lobe of Beckmann's distribution, f0 A + B: f0 blends between B and E = A + B.
/// Twenty-four operations: quotients of sums of powers of mu and the widths.
fn beckmann_blend_24(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let dividend = alpha * (c0 + mu * (c1 + alpha * (c2 + c3 * alpha) + c4 * mu));
    let divisor = d0 + mu * (d1 + mu * (d2 + d3 * mu)) + roughness * (alpha + d4 * mu);
    let part = a0 + a1 * mu;
    let mu2 = mu * mu;
    let whole = b0 + mu * (b1 + mu2) + alpha * (b2 + b3 * roughness);
    return (dividend + divisor) * (part + f0 * (whole - part)) / (divisor * whole);
}
