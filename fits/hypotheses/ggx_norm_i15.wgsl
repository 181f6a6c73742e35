override c0: f32 = 0.026667686;
override c1: f32 = -0.19894685;
override c2: f32 = 0.0840193;
override c3: f32 = 2.0283935;
override c4: f32 = -2.1168292;
override c5: f32 = 3.2714155;
override c6: f32 = -3.3699596;
override c7: f32 = 2.7472363;
override c8: f32 = 3.5809844;
override k: f32 = 1.0327616;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Fifteen operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i15(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let facing = mu * inverse;
    return 1.0 + alpha * (c0 + facing * (c1 + facing * (c2 + inverse * (c3 + facing * c4))
        + alpha * (c5 + mu * (c6 + alpha * (c7 + facing * c8)))));
}
