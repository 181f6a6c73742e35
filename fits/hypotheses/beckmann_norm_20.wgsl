override c0: f32 = 0.95153904;
override c1: f32 = -1.2051544;
override c2: f32 = 0.40564334;
override c3: f32 = 6.176867;
override c4: f32 = -5.097137;
override c5: f32 = -18.286814;
override c6: f32 = -1.5109888;
override c7: f32 = -12.473877;
override c8: f32 = 26.759249;
override c9: f32 = 10.260247;
override c10: f32 = 66.15925;
override c11: f32 = -99.78299;
override c12: f32 = 80.849556;
override k0: f32 = 1.3597499;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Twenty operations. One reciprocal and a nested sum; mu and alpha times the reciprocal depend on mu/alpha alone.
/// Exactly 1 for a mirror.
fn beckmann_norm_20(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    let mu_alpha_inverse = mu * alpha_inverse;
    return 1.0 + mu_alpha_inverse * (c0 + mu * (c1 + inverse * (c2 + alpha_inverse * (c5 + inverse * (c6
        + alpha_inverse * c9 + mu_alpha_inverse * c10))) + roughness * (c3 + mu * c4) + mu_alpha_inverse * (c7
        + mu * (c8 + mu_alpha_inverse * (c11 + roughness * c12)))));
}
