override c0: f32 = 0.203626;
override c1: f32 = 2.81088;
override d0: f32 = -0.132327;
override d1: f32 = 1.16178;
override d2: f32 = 0.942138;
override d3: f32 = -1.67041;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Fifteen operations. Rational in alpha and mu. The divisor is homogeneous of degree 2 where both are small, so the layer
/// mu ~ alpha is resolved at every roughness. Exactly 1 at alpha = 0 and at mu = 0.
fn ggx_norm_q15(alpha: f32, mu: f32) -> f32 {
    let a2 = alpha * alpha;
    let loss = alpha * mu * (c0 + c1 * a2);
    let divisor = a2 * (1.0 + d0 * a2) + mu * (d1 * a2 + mu * (d2 + d3 * a2));
    return 1.0 + loss / divisor;
}
