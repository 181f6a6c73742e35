override c0: f32 = -0.07021832;
override c1: f32 = -0.47038758;
override c2: f32 = 2.7839358;
override c3: f32 = 2.7413173;
override c4: f32 = 0.57006;
override c5: f32 = -31.132395;
override c6: f32 = 43.251354;
override k0: f32 = 1.6874648;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Fourteen operations. One reciprocal and a nested sum; mu and alpha times the reciprocal depend on mu/alpha alone.
/// Exactly 1 for a mirror.
fn beckmann_norm_14(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    let mu_alpha_inverse = mu * alpha_inverse;
    return 1.0 + mu_alpha_inverse * (c0 + inverse * (c1 + alpha_inverse * c2) + mu_alpha_inverse * (c3 + mu * (c4
        + mu_alpha_inverse * (c5 + alpha * c6))));
}
