override c0: f32 = 0.38909;
override c1: f32 = 2.92899;
override d0: f32 = 1.18097;
override d1: f32 = 1.61408;
override d2: f32 = -2.35779;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Thirteen operations. Rational in alpha and mu. The divisor is homogeneous of degree 2 where both are small, so the layer
/// mu ~ alpha is resolved at every roughness. Exactly 1 at alpha = 0 and at mu = 0.
fn ggx_norm_q13(alpha: f32, mu: f32) -> f32 {
    let a2 = alpha * alpha;
    let loss = alpha * mu * (c0 + c1 * a2);
    let divisor = a2 + mu * (d0 * alpha + mu * (d1 + d2 * alpha));
    return 1.0 + loss / divisor;
}
