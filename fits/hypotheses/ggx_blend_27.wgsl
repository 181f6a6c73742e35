override c0: f32 = -0.0055563073;
override c1: f32 = -0.4128085;
override c2: f32 = 0.23585445;
override c3: f32 = -3.514061;
override d0: f32 = 0.0516986;
override d1: f32 = -0.94971377;
override d2: f32 = 6.240244;
override d3: f32 = 4.5119896;
override d4: f32 = -5.5824285;
override b0: f32 = 1.0415183;
override b1: f32 = -0.7711683;
override b2: f32 = 17.557283;
override b3: f32 = 2.6055813;
override b4: f32 = -145.66579;
override b5: f32 = 382.68994;
override b6: f32 = 55.426132;
override b7: f32 = -193.70937;
override b8: f32 = 590.0967;

/// Reflection of a Schlick Fresnel lobe, f0 A + B: E = A + B and the share B/E are two forms, and f0 blends between E and B.
/// Twenty-seven operations: two quotients with one division.
fn ggx_blend_27(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let cube = alpha * roughness;
    let loss = alpha * (c0 + mu * (c1 + alpha * (c2 + c3 * alpha)));
    let divisor = cube + mu * (d0 + roughness * (d1 + d2 * cube) + mu * (d3 + d4 * roughness));
    let falloff = b3 + alpha * (b4 + b5 * roughness) + mu * (b6 + mu * (b7 + b8 * mu));
    let whole = b0 + roughness * (b1 + b2 * roughness) + mu * falloff;
    return (divisor + loss) * (1.0 + f0 * (whole - 1.0)) / (divisor * whole);
}
