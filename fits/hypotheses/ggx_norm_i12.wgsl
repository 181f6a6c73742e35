override c0: f32 = 0.0018509724;
override c1: f32 = -0.22822957;
override c2: f32 = 3.2461488;
override c3: f32 = -8.859226;
override c4: f32 = -0.38727108;
override c5: f32 = 3.1292222;
override c6: f32 = 19.183449;
override k: f32 = 2.1678104;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Twelve operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i12(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    return 1.0 + alpha * (c0 + mu * (c1 + alpha * (c2 + inverse * (c3 + inverse * (c4 + inverse * c5
        + roughness * c6)))));
}
