override c0: f32 = -0.048169248;
override c1: f32 = 0.2452336;
override c2: f32 = 0.11324242;
override c3: f32 = -2.5186424;
override c4: f32 = 0.9388694;
override c5: f32 = -0.29561856;
override k: f32 = 0.8183304;
override b0: f32 = 0.97267175;
override b1: f32 = 14.45944;
override b2: f32 = 5.4326935;
override b3: f32 = -174.21481;
override b4: f32 = 496.063;
override b5: f32 = -0.6903101;
override b6: f32 = 146.72676;

/// Reflection of a Schlick Fresnel lobe, f0 A + B: E = A + B and the share B/E are two forms, and f0 blends between E and B.
/// Twenty-four operations: one reciprocal resolves the layer mu ~ alpha of E, another is the share.
fn ggx_blend_24(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let layer = inverse * (c2 + alpha * (c3 + c4 * alpha) + c5 * inverse);
    let albedo = 1.0 + alpha * (c0 + mu * (c1 + layer));
    let falloff = b2 + alpha * (b3 + b4 * roughness) + mu * (b5 + b6 * mu);
    let share = 1.0 / (b0 + b1 * alpha + mu * falloff);
    return albedo * (share + f0 * (1.0 - share));
}
