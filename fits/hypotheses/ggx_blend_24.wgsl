override c0: f32 = -0.048194993;
override c1: f32 = 0.24270988;
override c2: f32 = 0.11496927;
override c3: f32 = -2.5126054;
override c4: f32 = 0.9358658;
override c5: f32 = -0.29552788;
override k: f32 = 0.8174756;
override b0: f32 = 0.96966666;
override b1: f32 = 14.7737665;
override b2: f32 = 5.0539956;
override b3: f32 = -177.51997;
override b4: f32 = 490.40482;
override b5: f32 = 5.9830136;
override b6: f32 = 124.61042;

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
