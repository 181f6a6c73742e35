override c0: f32 = 0.00832089;
override c1: f32 = -0.25431934;
override c2: f32 = -2.0236678;
override c3: f32 = 3.6106467;
override c4: f32 = 1.2114084;
override c5: f32 = 2.755893;
override c6: f32 = 2.308955;
override k: f32 = 1.8761659;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Twelve operations. One reciprocal: mu and alpha times it depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness.
/// Exactly 1 for a mirror.
fn ggx_norm_i12(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let layer = inverse * (c4 + inverse * (c5 + c6 * inverse));
    return 1.0 + alpha * (c0 + mu * (c1 + roughness * (c2 + roughness * (c3 + layer))));
}
