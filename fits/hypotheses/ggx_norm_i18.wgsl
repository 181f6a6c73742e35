override c0: f32 = -0.020664353;
override c1: f32 = 0.03710299;
override c2: f32 = 0.3602422;
override c3: f32 = 3.168652;
override c4: f32 = -0.21071042;
override c5: f32 = 10.726797;
override c6: f32 = 7.0921702;
override c7: f32 = -11.274564;
override c8: f32 = 12.532971;
override c9: f32 = -24.260956;
override c10: f32 = -6.459749;
override c11: f32 = 14.6856165;
override k: f32 = 1.0640895;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Eighteen operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i18(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    return 1.0 + ratio * (c0 + alpha * (c1 + mu * (c2 + ratio * (c3 + inverse * (c4 + inverse * (c5 + ratio * (c9 + ratio * c11)))
        + mu * (c6 + mu * (c7 + roughness * c8) + ratio * c10)))));
}
