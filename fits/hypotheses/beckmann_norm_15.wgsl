override c0: f32 = 0.31990108;
override c1: f32 = 6.7337523;
override c2: f32 = -5.607391;
override c3: f32 = -4.908637;
override c4: f32 = 29.77614;
override c5: f32 = -15.384702;
override c6: f32 = -26.995459;
override c7: f32 = 48.77013;
override k0: f32 = 1.7626175;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Fifteen operations. One reciprocal and a nested sum; mu and alpha times the reciprocal depend on mu/alpha alone.
/// Exactly 1 for a mirror.
fn beckmann_norm_15(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    let mu_alpha_inverse = mu * alpha_inverse;
    return 1.0 + mu_alpha_inverse * (c0 + mu_alpha_inverse * (c1 + inverse * (c2 + inverse * (c3
        + alpha_inverse * c4)) + mu_alpha_inverse * (c5 + mu * (c6 + alpha * c7))));
}
