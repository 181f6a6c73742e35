override c0: f32 = 0.016163254;
override c1: f32 = -0.40095463;
override c2: f32 = -2.852462;
override c3: f32 = 4.177504;
override c4: f32 = -1.531172;

/// Cosine-weighted mean over directions of the GGX reflection albedo, E_avg.
/// Five operations: a polynomial in roughness and alpha, in Horner form; the better of its cost by its largest error.
/// Exactly 1 for a mirror.
fn ggx_eavg_5p(roughness: f32, alpha: f32) -> f32 {
    return 1.0 + alpha * (c0 + roughness * (c1 + roughness * (c2 + roughness * (c3 + c4 * roughness))));
}
