override c0: f32 = -0.053348113;
override c1: f32 = 0.12209176;
override c2: f32 = 0.53835654;
override c3: f32 = -1.8050746;
override c4: f32 = -0.30309626;
override k: f32 = 0.8192325;
override b0: f32 = 1.0058358;
override b1: f32 = 4.3033752;
override b2: f32 = 8.352239;
override b3: f32 = 98.46126;
override b4: f32 = 7.7466063;
override b5: f32 = 19.980886;

/// Reflection of a Schlick Fresnel lobe, f0 A + B: E = A + B and the share B/E are two forms, and f0 blends between E and B.
/// Twenty-two operations: one reciprocal resolves the layer mu ~ alpha of E, another is the share.
fn ggx_blend_22(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let layer = inverse * (c2 + c3 * roughness + c4 * inverse);
    let albedo = 1.0 + alpha * (c0 + mu * (c1 + layer));
    let share = 1.0 / (b0 + mu * (b1 + mu * (b2 + b3 * mu)) + alpha * (b4 + b5 * roughness));
    return albedo * (share + f0 * (1.0 - share));
}
