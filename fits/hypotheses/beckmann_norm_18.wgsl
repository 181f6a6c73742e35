override c0: f32 = 0.19800027;
override c1: f32 = 0.6979035;
override c2: f32 = 0.35569277;
override c3: f32 = -6.7761292;
override c4: f32 = -1.0854598;
override c5: f32 = -2.902076;
override c6: f32 = 9.098714;
override c7: f32 = 8.313445;
override c8: f32 = 28.464487;
override c9: f32 = -67.99396;
override c10: f32 = 62.549488;
override k0: f32 = 1.2969837;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Eighteen operations. One reciprocal and a nested sum; mu and alpha times the reciprocal depend on mu/alpha alone.
/// Exactly 1 for a mirror.
fn beckmann_norm_18(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    let mu_alpha_inverse = mu * alpha_inverse;
    return 1.0 + mu_alpha_inverse * (c0 + alpha * c1 + mu_alpha_inverse * (c2 + inverse * (c3 + inverse * (c4
        + alpha_inverse * c7 + mu_alpha_inverse * c8)) + mu * (c5 + mu * (c6 + mu_alpha_inverse * (c9
        + roughness * c10)))));
}
