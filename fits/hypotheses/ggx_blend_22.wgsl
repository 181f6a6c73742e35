override c0: f32 = -0.053625036;
override c1: f32 = 0.22299115;
override c2: f32 = 0.56464154;
override c3: f32 = -2.063955;
override c4: f32 = -0.34289363;
override k: f32 = 0.90229094;
override b0: f32 = 1.037233;
override b1: f32 = 3.609843;
override b2: f32 = 13.0514965;
override b3: f32 = 92.86271;
override b4: f32 = 6.7139354;
override b5: f32 = 25.39046;

/// Reflection of a Schlick Fresnel lobe, f0 A + B: E = A + B and the share B/E are two forms, and f0 blends between E and B.
/// Twenty-two operations: one reciprocal resolves the layer mu ~ alpha of E, another is the share.
fn ggx_blend_22(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let layer = inverse * (c2 + c3 * roughness + c4 * inverse);
    let albedo = 1.0 + alpha * (c0 + mu * (c1 + layer));
    let share = 1.0 / (b0 + mu * (b1 + mu * (b2 + b3 * mu)) + alpha * (b4 + b5 * roughness));
    return albedo * (share + f0 * (1.0 - share));
}
