override c0: f32 = 0.0154882725;
override c1: f32 = -0.24802347;
override c2: f32 = 0.5361405;
override c3: f32 = -1.0715108;
override c4: f32 = 9.988987;
override c5: f32 = -20.279959;
override c6: f32 = 10.99358;
override c7: f32 = 4.1852427;
override c8: f32 = 0.6197304;
override c9: f32 = 5.457961;
override c10: f32 = -16.957094;
override c11: f32 = 32.149475;
override c12: f32 = -47.556393;
override k: f32 = 1.3579077;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Nineteen operations. One reciprocal, and a nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i19(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let facing = mu * inverse;
    return 1.0 + alpha * (c0 + facing * (c1 + inverse * (c2 + facing * (c3 + facing * (c4
        + facing * (c5 + facing * c6)))) + alpha * (c7 + alpha * (c8 + mu * c9 + facing * (c10
        + facing * (c11 + facing * c12))))));
}
