override c0: f32 = 0.029202694;
override c1: f32 = -0.64498115;
override c2: f32 = 0.3360101;
override c3: f32 = 2.9820845;
override c4: f32 = 1.4627482;
override c5: f32 = -4.7819695;
override c6: f32 = 4.1403685;
override c7: f32 = 0.1656383;
override c8: f32 = 1.6527953;
override k: f32 = 0.94452107;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Fifteen operations. One reciprocal: mu and alpha times it depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every
/// roughness. Exactly 1 for a mirror.
fn ggx_norm_i15(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let square = inverse * inverse;
    let layer = c6 + square * (c7 + c8 * square);
    return 1.0 + alpha * (c0 + mu * (c1 + alpha * (c2 + c3 * inverse) + mu * (c4 + roughness * (c5 + roughness * layer))));
}
