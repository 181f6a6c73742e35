override c0: f32 = 0.262013;
override c1: f32 = 2.43197;
override d0: f32 = -0.270851;
override d1: f32 = 1.11992;
override d2: f32 = 1.3569;
override d3: f32 = -1.41764;
override d4: f32 = -0.621103;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Sixteen operations. Rational in alpha and mu. The divisor is homogeneous of degree 2 where both are small, so the layer
/// mu ~ alpha is resolved at every roughness. Exactly 1 at alpha = 0 and at mu = 0.
fn ggx_norm_q16(alpha: f32, mu: f32) -> f32 {
    let a2 = alpha * alpha;
    let loss = alpha * mu * (c0 + c1 * a2);
    let square = d2 + alpha * (d3 + d4 * alpha);
    let divisor = a2 * (1.0 + d0 * a2) + mu * (d1 * a2 + mu * square);
    return 1.0 + loss / divisor;
}
