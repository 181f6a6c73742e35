override c0: f32 = -0.7264669;
override c1: f32 = 2.4359386;
override c2: f32 = 0.037606467;
override c3: f32 = 0.35082346;
override c4: f32 = 1.4087852;
override k: f32 = 0.998311;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Eleven operations. One reciprocal: mu and alpha times it depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness.
/// Exactly 1 for a mirror and at grazing incidence.
fn ggx_norm_i11(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let layer = inverse * (c2 + inverse * (c3 + c4 * alpha));
    return 1.0 + alpha * mu * (c0 + c1 * alpha + layer);
}
