override c0: f32 = 0.45158866;
override c1: f32 = 5.003185;
override c2: f32 = -7.0452876;
override c3: f32 = -3.5153522;
override c4: f32 = 22.631205;
override c5: f32 = 17.602108;
override c6: f32 = -35.790405;
override c7: f32 = -25.468943;
override c8: f32 = 53.212757;
override k0: f32 = 1.6285677;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Sixteen operations. One reciprocal and a nested sum; mu and alpha times the reciprocal depend on mu/alpha alone.
/// Exactly 1 for a mirror.
fn beckmann_norm_16(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    let mu_alpha_inverse = mu * alpha_inverse;
    return 1.0 + mu_alpha_inverse * (c0 + mu_alpha_inverse * (c1 + inverse * (c2 + inverse * (c3
        + alpha_inverse * c4)) + mu_alpha_inverse * (c5 + mu * (c6 + alpha * c8) + roughness * c7)));
}
