override c0: f32 = -0.007343374;
override c1: f32 = -0.31065887;
override c2: f32 = 0.08431918;
override c3: f32 = -3.6067865;
override d0: f32 = 0.08543152;
override d1: f32 = -1.2711985;
override d2: f32 = 6.8216066;
override d3: f32 = 4.5032744;
override d4: f32 = -5.551791;
override a0: f32 = 0.9855121;
override a1: f32 = -1.3173946;
override b0: f32 = 9.926668;
override b1: f32 = 13.597809;
override b2: f32 = 2.3654914;
override b3: f32 = -9.869474;
override b4: f32 = 21.655561;

/// Reflection of a Schlick Fresnel lobe, f0 A + B: E = A + B and the share B/E are two forms, and f0 blends between E and B.
/// Twenty-five operations: two quotients with one division.
fn ggx_blend_25(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let cube = alpha * roughness;
    let loss = alpha * (c0 + mu * (c1 + alpha * (c2 + c3 * alpha)));
    let divisor = cube + mu * (d0 + roughness * (d1 + d2 * cube) + mu * (d3 + d4 * roughness));
    let falloff = b2 + b3 * roughness + b4 * mu;
    let part = a0 + a1 * mu;
    let whole = 1.0 + alpha * (b0 + b1 * roughness) + mu * falloff;
    return (divisor + loss) * (part + f0 * (whole - part)) / (divisor * whole);
}
