override c0: f32 = 0.143314;
override c1: f32 = 2.51491;
override d0: f32 = 0.876904;
override d1: f32 = -0.627293;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Twelve operations. Rational in alpha and mu. The divisor is homogeneous of degree 2 where both are small, so the layer
/// mu ~ alpha is resolved at every roughness. Exactly 1 at alpha = 0 and at mu = 0.
fn ggx_norm_q12(alpha: f32, mu: f32) -> f32 {
    let a2 = alpha * alpha;
    let loss = alpha * mu * (c0 + c1 * a2);
    let divisor = a2 + mu * mu * (d0 + d1 * a2);
    return 1.0 + loss / divisor;
}
