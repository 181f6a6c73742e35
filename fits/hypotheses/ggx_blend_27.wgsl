override c0: f32 = -0.006265282;
override c1: f32 = -0.3364487;
override c2: f32 = 0.15161528;
override c3: f32 = -3.4612515;
override d0: f32 = 0.06674118;
override d1: f32 = -1.1031605;
override d2: f32 = 6.213288;
override d3: f32 = 4.177812;
override d4: f32 = -5.0900626;
override b0: f32 = 1.024071;
override b1: f32 = -0.6724716;
override b2: f32 = 17.268934;
override b3: f32 = 3.3665555;
override b4: f32 = -141.52724;
override b5: f32 = 370.95627;
override b6: f32 = 42.03616;
override b7: f32 = -114.33938;
override b8: f32 = 436.34018;

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
