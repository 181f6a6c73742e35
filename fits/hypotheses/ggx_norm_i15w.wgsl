override c0: f32 = 0.029565532;
override c1: f32 = -1.3575361;
override c2: f32 = 10.144016;
override c3: f32 = -9.885615;
override c4: f32 = 13.791683;
override c5: f32 = 12.891233;
override c6: f32 = -8.660266;
override c7: f32 = 75.21013;
override k: f32 = 1.6251414;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Fifteen operations, of less error than ggx_norm_i15, for the range of f32: a coefficient times the square of the reciprocal
/// overflows a half where mu and alpha are small. A nested sum in which each monomial is another one times a step. mu and alpha times
/// the reciprocal depend on mu/alpha alone, so the layer mu ~ alpha is resolved at every roughness. Exactly 1 for a mirror.
fn ggx_norm_i15w(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    let facing = mu * ratio;
    return 1.0 + ratio * (c0 + facing * (c1 + alpha * (c2 + facing * (c6 + facing * c7))
        + facing * (c3 + inverse * (c4 + inverse * c5))));
}
