override c0: f32 = 0.019724134;
override c1: f32 = -0.3981123;
override c2: f32 = -1.2273155;
override c3: f32 = 11.793938;
override c4: f32 = 23.7039;
override c5: f32 = -37.649555;
override c6: f32 = -52.72144;
override c7: f32 = 25.754782;
override c8: f32 = 52.407036;
override c9: f32 = 162.52928;
override k: f32 = 1.7619177;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Seventeen operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i17(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    let facing = mu * ratio;
    return 1.0 + ratio * (c0 + facing * (c1 + inverse * (c2 + ratio * (c4 + ratio * c5))
        + alpha * (c3 + facing * (c6 + alpha * c7 + facing * (c8 + inverse * c9)))));
}
